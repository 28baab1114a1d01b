// SPDX-License-Identifier: BSD-3-Clause
#include "run/ExplanationByMesh.h"

#include "mesh/MeasuredSurface.h"
#include "mesh/NearestTriangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Between two looks at whether to go on.
constexpr std::size_t PointsPerLook = 16384;
constexpr std::size_t AskedPerRange = 512;
/// A place is on an edge if it is no farther from it than so many of its lengths.
constexpr double OnEdge = 1e-6;

using Triangle = std::array<std::uint32_t, 3>;

std::pair<std::uint32_t, std::uint32_t> edgeAt(const Triangle& triangle, std::size_t corner)
{
  return std::minmax(triangle[corner], triangle[(corner + 1) % triangle.size()]);
}

/// For each edge of each triangle, whether no other triangle has it.
std::vector<std::array<bool, 3>> boundaryEdges(const std::vector<Triangle>& triangles)
{
  struct Edge
  {
    std::pair<std::uint32_t, std::uint32_t> ends;
    std::size_t place; ///< three to a triangle
  };
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles)
  {
    for (std::size_t corner = 0; corner < triangle.size(); ++corner)
    {
      edges.push_back({ edgeAt(triangle, corner), edges.size() });
    }
  }
  std::sort(
    edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends < b.ends; });
  std::vector<std::array<bool, 3>> isBoundary(triangles.size());
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    const bool isLikeLast = i > 0 && edges[i - 1].ends == edges[i].ends;
    const bool isLikeNext = i + 1 < edges.size() && edges[i + 1].ends == edges[i].ends;
    isBoundary[edges[i].place / 3][edges[i].place % 3] = !isLikeLast && !isLikeNext;
  }
  return isBoundary;
}

/// A surface in the coordinates of the cloud, and its edges of one triangle.
class ExplainingSurface
{
public:
  ExplainingSurface(const TriangleMesh& mesh, const Executor& executor)
    : mesh_(mesh)
    , nearest_(mesh, executor)
    , isBoundary_(boundaryEdges(mesh.triangles))
  {
  }

  double meanEdge() const
  {
    double length = 0.;
    for (const Triangle& triangle : mesh_.triangles)
    {
      for (std::size_t corner = 0; corner < triangle.size(); ++corner)
      {
        const auto [a, b] = edgeAt(triangle, corner);
        length += (mesh_.points[a] - mesh_.points[b]).norm();
      }
    }
    return length / double(3 * mesh_.triangles.size());
  }

  struct Found
  {
    double distance;
    bool isOnBoundary;
  };

  Found find(const Eigen::Vector3d& point) const
  {
    const NearestTriangle::Found found = nearest_.find(point);
    const Triangle& triangle = mesh_.triangles[found.triangle];
    bool isOnBoundary = false;
    for (std::size_t corner = 0; corner < triangle.size(); ++corner)
    {
      const auto [a, b] = edgeAt(triangle, corner);
      isOnBoundary = isOnBoundary ||
        (isBoundary_[found.triangle][corner] &&
          isOn(found.place, mesh_.points[a], mesh_.points[b]));
    }
    return { std::sqrt(found.squaredDistance), isOnBoundary };
  }

private:
  static bool isOn(const Eigen::Vector3d& place, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  {
    const Eigen::Vector3d side = b - a;
    return (place - a).cross(side).norm() <= OnEdge * side.squaredNorm();
  }

  const TriangleMesh& mesh_;
  NearestTriangle nearest_;
  std::vector<std::array<bool, 3>> isBoundary_;
};

std::optional<PointDistances> distancesOfAll(const PointCloud& cloud,
  const ExplainingSurface& surface, const Progress& progress, const Executor& executor)
{
  const std::size_t count = cloud.points().size();
  PointDistances result;
  result.meanEdge = surface.meanEdge();
  result.points.resize(count);
  std::iota(result.points.begin(), result.points.end(), std::uint32_t(0));
  result.distances.resize(count);
  result.isBeyondBoundary.resize(count);
  for (std::size_t first = 0; first < count; first += PointsPerLook)
  {
    if (!progress(double(first) / double(count)))
    {
      return std::nullopt;
    }
    executor.forEachRange(std::min(PointsPerLook, count - first), AskedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          const auto found = surface.find(cloud.points()[i].toDouble());
          result.distances[i] = float(found.distance);
          result.isBeyondBoundary[i] = found.isOnBoundary ? 1 : 0;
        }
      });
  }
  return result;
}
}

std::optional<Explanation> explainByMesh(const PointCloud& cloud, const TriangleMesh& mesh,
  const ExplanationRules& rules, const Progress& progress, const Executor& executor)
{
  MeasuredSurface surface(mesh);
  surface.transform(cloud.toInput({}), cloud.unit());
  if (!surface.hasArea())
  {
    throw std::runtime_error("The mesh has no triangle with an area.");
  }
  std::optional<PointDistances> distances =
    distancesOfAll(cloud, ExplainingSurface(surface.mesh(), executor), progress, executor);
  if (!distances)
  {
    return std::nullopt;
  }
  return explain(cloud, *std::move(distances), rules, executor);
}
}
