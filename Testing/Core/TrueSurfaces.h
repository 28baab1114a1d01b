// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "cloud/CloudDistance.h"
#include "cloud/CloudGenerator.h"
#include "mesh/SurfaceSampler.h"
#include "Shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace neuralmesh::testing
{
/// A shape to draw clouds from, whose distance to any point is known.
struct TrueSurface
{
  std::string name;
  TriangleMesh triangles;
  long genus = 0;
  double diagonal = 0.; ///< of the bounding box
  std::function<double(const Eigen::Vector3d&)> distance;
};

inline TrueSurface trueSphere()
{
  return { "Sphere", makeSphere(), 0, 2. * std::sqrt(3.),
    [](const Eigen::Vector3d& point) { return std::abs(point.norm() - 1.); } };
}

inline TrueSurface trueTorus()
{
  return { "Torus", makeTorus(), 1, std::sqrt(2. * 2.8 * 2.8 + 0.8 * 0.8),
    [](const Eigen::Vector3d& point)
    { return std::abs(std::hypot(std::hypot(point.x(), point.y()) - 1., point.z()) - 0.4); } };
}

inline TrueSurface trueCube()
{
  return { "Cube", makeCube(), 0, std::sqrt(3.),
    [](const Eigen::Vector3d& point)
    {
      const Eigen::Vector3d beyond = point.cwiseAbs() - Eigen::Vector3d::Constant(0.5);
      return std::abs(beyond.cwiseMax(0.).norm() + std::min(0., beyond.maxCoeff()));
    } };
}

inline double largestDistance(const TrueSurface& surface, const TriangleMesh& mesh)
{
  double largest = 0.;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    largest = std::max(largest, surface.distance(point));
  }
  return largest;
}

/// Root of the mean square over the area of the mesh.
inline double rmsDistance(const TrueSurface& surface, const TriangleMesh& mesh)
{
  Random random(1);
  const auto samples = SurfaceSampler(mesh).drawFromShares(5000, random);
  double sum = 0.;
  for (const SurfaceSampler::Sample& sample : samples)
  {
    sum += std::pow(surface.distance(sample.point), 2);
  }
  return std::sqrt(sum / double(samples.size()));
}

/// The farthest from the mesh of so many points of the surface.
inline double largestDistanceTo(
  const TriangleMesh& mesh, const TrueSurface& surface, std::size_t count)
{
  Random random(1);
  double largest = 0.;
  for (const auto& sample : SurfaceSampler(surface.triangles).drawFromShares(count, random))
  {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b, c] : mesh.triangles)
    {
      least = std::min(least,
        squaredDistanceToTriangle(sample.point, mesh.points[a], mesh.points[b], mesh.points[c]));
    }
    largest = std::max(largest, std::sqrt(least));
  }
  return largest;
}
}
