// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSampler.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
SurfaceSampler::SurfaceSampler(const TriangleMesh& surface)
  : surface_(surface)
{
  areaUpTo_.reserve(surface.triangles.size());
  double area = 0.;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Eigen::Vector3d& corner = surface.points[a];
    area += (surface.points[b] - corner).cross(surface.points[c] - corner).norm();
    areaUpTo_.push_back(area);
  }
}

std::vector<SurfaceSampler::Sample> SurfaceSampler::drawFromShares(
  std::size_t count, Random& random) const
{
  std::vector<Sample> samples;
  samples.reserve(count);
  while (samples.size() < count)
  {
    const double share = double(samples.size()) + random.uniform();
    samples.push_back(drawAt(share / double(count), random));
  }
  return samples;
}

Eigen::Vector3d SurfaceSampler::drawFromTriangle(std::size_t triangle, Random& random) const
{
  const auto& [a, b, c] = surface_.triangles[triangle];
  const double r = std::sqrt(random.uniform());
  const double s = random.uniform();
  return (1. - r) * surface_.points[a] + r * (1. - s) * surface_.points[b] +
    r * s * surface_.points[c];
}

SurfaceSampler::Sample SurfaceSampler::drawAt(double fraction, Random& random) const
{
  const auto place =
    std::upper_bound(areaUpTo_.begin(), areaUpTo_.end(), fraction * areaUpTo_.back());
  const auto triangle = std::min(std::size_t(place - areaUpTo_.begin()), areaUpTo_.size() - 1);
  return { drawFromTriangle(triangle, random), triangle };
}
}
