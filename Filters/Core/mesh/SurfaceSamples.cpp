// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSamples.h"

#include "base/Random.h"
#include "mesh/SurfaceSampler.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
/// No other random numbers of the seed are named so.
constexpr std::uint64_t StreamOfSurface = std::uint64_t(3) << 32;

/// How much of each corner is in a point of a triangle.
std::array<double, 3> cornerWeights(
  const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corners)
{
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const Eigen::Vector3d normal = ab.cross(ac), toPoint = point - corners[0];
  const double squared = normal.squaredNorm();
  if (!(squared > 0.))
  {
    return { 1., 0., 0. };
  }
  const double b = std::clamp(toPoint.cross(ac).dot(normal) / squared, 0., 1.);
  const double c = std::clamp(ab.cross(toPoint).dot(normal) / squared, 0., 1. - b);
  return { 1. - b - c, b, c };
}

Eigen::Vector3f normalOf(const TriangleMesh& mesh, std::size_t triangle)
{
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d& corner = mesh.points[a];
  return (mesh.points[b] - corner).cross(mesh.points[c] - corner).stableNormalized().cast<float>();
}
}

SurfaceSamples sampleSurface(
  const TriangleMesh& input, const ManifoldSurface& surface, std::size_t count, std::uint64_t seed)
{
  if (input.triangles.empty())
  {
    throw std::runtime_error("The input is no surface: it has no triangles.");
  }
  const SurfaceSampler sampler(surface.mesh);
  if (!sampler.hasArea())
  {
    throw std::runtime_error("The input is no surface: its triangles have no area.");
  }
  Random random(seed, StreamOfSurface);
  SurfaceSamples result;
  result.points.reserve(count);
  result.normals.reserve(count);
  result.triangles.reserve(count);
  result.weights.reserve(count);
  for (const SurfaceSampler::Sample& sample : sampler.drawFromShares(count, random))
  {
    const std::uint32_t triangle = surface.origins[sample.triangle];
    const auto& [a, b, c] = input.triangles[triangle];
    result.points.push_back(sample.point);
    result.normals.push_back(normalOf(surface.mesh, sample.triangle));
    result.triangles.push_back(triangle);
    result.weights.push_back(
      cornerWeights(sample.point, { input.points[a], input.points[b], input.points[c] }));
  }
  return result;
}
}
