// SPDX-License-Identifier: BSD-3-Clause
#include "run/ComparedEdges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace neuralmesh
{
namespace
{
/// The turn from which on an edge is sharp, as it is for VTK, ParaView and others who draw such edges.
constexpr double LeastTurn = std::numbers::pi / 6.;
/// Of an extent of 1. Points of files with single precision are rounded by a tenth of this.
constexpr double LeastHeight = 1e-6;
constexpr std::size_t EdgePointsPerRange = 512;
constexpr double NoEdges = std::numeric_limits<double>::quiet_NaN();

/// Triangles that are as thin as lines.
TriangleMesh asTriangles(const std::vector<EdgeEnds>& edges)
{
  TriangleMesh mesh;
  for (const auto& [from, to] : edges)
  {
    const auto index = std::uint32_t(mesh.points.size());
    mesh.points.push_back(from);
    mesh.points.push_back(to);
    mesh.triangles.push_back({ index, index + 1, index + 1 });
  }
  return mesh;
}
}

ComparedEdges::ComparedEdges(const TriangleMesh& surface, std::size_t count, Random random)
  : edges_(sharpEdges(surface, LeastTurn, LeastHeight))
  , nearest_(asTriangles(edges_))
{
  double length = 0.;
  lengthUpTo_.reserve(edges_.size());
  for (const auto& [from, to] : edges_)
  {
    length += (to - from).norm();
    lengthUpTo_.push_back(length);
  }
  points_.reserve(length > 0. ? count : 0);
  while (length > 0. && points_.size() < count)
  {
    const double share = (double(points_.size()) + random.uniform()) / double(count);
    points_.push_back(pointAt(share * length));
  }
}

double ComparedEdges::meanTo(const ComparedEdges& other, const Executor& executor) const
{
  return other.points_.empty() ? NoEdges : meanTo(other.nearest_, executor);
}

double ComparedEdges::meanTo(const NearestTriangle& surface, const Executor& executor) const
{
  if (points_.empty())
  {
    return NoEdges;
  }
  const double sum = executor.sum(points_.size(), EdgePointsPerRange,
    [&](std::size_t i) { return std::sqrt(surface.find(points_[i]).squaredDistance); });
  return sum / double(points_.size());
}

Eigen::Vector3d ComparedEdges::pointAt(double length) const
{
  const auto place = std::upper_bound(lengthUpTo_.begin(), lengthUpTo_.end(), length);
  const auto edge = std::min(std::size_t(place - lengthUpTo_.begin()), edges_.size() - 1);
  const auto& [from, to] = edges_[edge];
  const double edgeLength = std::max((to - from).norm(), std::numeric_limits<double>::min());
  const double rest = std::clamp((lengthUpTo_[edge] - length) / edgeLength, 0., 1.);
  return to + rest * (from - to);
}
}
