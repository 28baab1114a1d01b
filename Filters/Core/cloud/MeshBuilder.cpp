// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/MeshBuilder.h"

#include "mesh/EachVertex.h"
#include "mesh/TriangleFans.h"
#include "mesh/TriangleList.h"
#include "mesh/VertexSplit.h"

#include <algorithm>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace neuralmesh
{
namespace
{
using Fan = TriangleFans::Fan;

void requirePoints(const TriangleMesh& mesh, const PointCloud& cloud)
{
  for (const auto& triangle : mesh.triangles)
  {
    for (const std::uint32_t point : triangle)
    {
      const std::string name = "point " + std::to_string(point);
      if (point >= mesh.points.size())
      {
        throw std::runtime_error("a triangle refers to " + name + ", but there are only " +
          std::to_string(mesh.points.size()) + " points");
      }
      if (!mesh.points[point].allFinite())
      {
        throw std::runtime_error(name + " is not finite");
      }
      if (!cloud.takesIn(mesh.points[point]))
      {
        throw std::runtime_error(
          name + " is farther from the cloud than a million times the size of the cloud");
      }
    }
  }
}

// --- Vertices with too many neighbours -----------------------------------------------------------

/// So many triangles of a long fan go to a new point at most, which then has 12 neighbours.
constexpr std::size_t TrianglesOfPart = 8;

/// Whether the triangles of a part of a fan keep their sides up if its point moves.
bool keepsSides(const TriangleMesh& mesh, std::uint32_t point, const Eigen::Vector3d& moved,
  std::span<const VertexIndex> neighbors)
{
  for (std::size_t i = 1; i < neighbors.size(); ++i)
  {
    const Eigen::Vector3d &a = mesh.points[neighbors[i - 1]], &b = mesh.points[neighbors[i]];
    const Eigen::Vector3d& center = mesh.points[point];
    if ((a - center).cross(b - center).dot((a - moved).cross(b - moved)) < 0.)
    {
      return false;
    }
  }
  return true;
}

/// From the point towards the middle of its neighbours in a part of its fan: half the shortest
/// edge, or so little of it that no triangle folds over.
Eigen::Vector3d centerOfPart(
  const TriangleMesh& mesh, std::uint32_t point, std::span<const VertexIndex> neighbors)
{
  constexpr double LeastStep = 0.01;
  const Eigen::Vector3d& center = mesh.points[point];
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  double shortest = std::numeric_limits<double>::infinity();
  for (const VertexIndex neighbor : neighbors)
  {
    const Eigen::Vector3d edge = mesh.points[neighbor] - center;
    direction += edge.stableNormalized();
    shortest = std::min(shortest, edge.stableNorm());
  }
  const Eigen::Vector3d whole = shortest * direction.stableNormalized();
  double step = 0.5;
  while (step > LeastStep && !keepsSides(mesh, point, center + step * whole, neighbors))
  {
    step *= 0.5;
  }
  return center + step * whole;
}

/// Splits a point several times at once: parts of its fan go to new points around it, which form
/// its new fan.
void splitFan(TriangleMesh& mesh, std::uint32_t point, const Fan& fan)
{
  const std::size_t count = fan.corners.size();
  const std::size_t parts =
    std::max<std::size_t>(3, (count + TrianglesOfPart - 1) / TrianglesOfPart);
  const auto firstOf = [&](std::size_t part) { return part * count / parts; };
  // The fan without a seam.
  std::vector<VertexIndex> neighbors = fan.neighbors;
  if (!fan.isOpen)
  {
    neighbors.push_back(neighbors.front());
  }
  const auto firstAdded = std::uint32_t(mesh.points.size());
  for (std::size_t part = 0; part < parts; ++part)
  {
    const auto added = std::uint32_t(firstAdded + part);
    mesh.points.push_back(centerOfPart(mesh, point,
      std::span(neighbors).subspan(firstOf(part), firstOf(part + 1) - firstOf(part) + 1)));
    for (std::size_t i = firstOf(part); i < firstOf(part + 1); ++i)
    {
      mesh.triangles[fan.corners[i] / 3][fan.corners[i] % 3] = added;
    }
    // Where this part meets the one before it.
    const std::uint32_t shared = neighbors[firstOf(part)];
    if (part > 0 || !fan.isOpen)
    {
      const auto before = std::uint32_t(part > 0 ? added - 1 : firstAdded + parts - 1);
      mesh.triangles.push_back({ before, shared, added });
      mesh.triangles.push_back({ point, before, added });
    }
    else
    {
      mesh.triangles.push_back({ point, shared, added });
    }
  }
  if (fan.isOpen)
  {
    mesh.triangles.push_back(
      { point, std::uint32_t(firstAdded + parts - 1), fan.neighbors.back() });
  }
}

/// Splits points whose rings would be too long, as far as no triangle of theirs is changed by
/// another split. Returns whether there were any.
///
/// Repeated, that comes to an end: of what exceeds 12 neighbours, summed over all points, less is
/// left each time. For n > 15 triangles become k parts, 3 or about n / 8, and then there are k
/// neighbours, no more than 12 at the new points, and one more at k others.
bool splitLongFans(TriangleMesh& mesh, const TriangleFans& fans)
{
  std::vector<std::pair<VertexIndex, Fan>> longFans;
  for (VertexIndex point = 0; point < mesh.points.size(); ++point)
  {
    if (fans.valence(point) > Ring::Capacity)
    {
      longFans.emplace_back(point, fans.at(point));
    }
  }
  std::vector<bool> isChanged(mesh.triangles.size(), false);
  for (const auto& [point, fan] : longFans)
  {
    const bool isIntact = std::none_of(
      fan.corners.begin(), fan.corners.end(), [&](auto corner) { return isChanged[corner / 3]; });
    if (isIntact)
    {
      splitFan(mesh, point, fan);
      for (const auto corner : fan.corners)
      {
        isChanged[corner / 3] = true;
      }
    }
  }
  return !longFans.empty();
}

// --- The mesh ------------------------------------------------------------------------------------

Mesh meshOf(const TriangleMesh& triangles, const TriangleFans& fans, const PointCloud& cloud)
{
  std::vector<VertexIndex> vertexOfPoint(triangles.points.size(), NoVertex);
  LargeVector<Vector4> positions;
  for (VertexIndex point = 0; point < triangles.points.size(); ++point)
  {
    if (fans.valence(point) > 0)
    {
      vertexOfPoint[point] = VertexIndex(positions.size());
      positions.push_back(cloud.fromInput(triangles.points[point]));
    }
  }
  LargeVector<Ring> rings;
  rings.reserve(positions.size());
  for (VertexIndex point = 0; point < triangles.points.size(); ++point)
  {
    if (fans.valence(point) > 0)
    {
      Fan fan = fans.at(point);
      for (VertexIndex& neighbor : fan.neighbors)
      {
        neighbor = vertexOfPoint[neighbor];
      }
      rings.emplace_back().assign(fan.neighbors, fan.isOpen);
    }
  }
  return { std::move(positions), std::move(rings) };
}

bool canGrow(const Mesh& mesh)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (planVertexSplit(mesh, v))
    {
      return true;
    }
  }
  return false;
}

/// The vertex whose edge to the first of its ring is the longest boundary edge; NoVertex if there
/// is no boundary.
VertexIndex atLongestBoundaryEdge(const Mesh& mesh)
{
  VertexIndex longest = NoVertex;
  float most = -1.f;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isBoundary(v))
    {
      const float squared = squaredNorm(mesh.position(mesh.ring(v).front()) - mesh.position(v));
      if (squared > most)
      {
        most = squared;
        longest = v;
      }
    }
  }
  return longest;
}

void splitBoundaryUntilItGrows(Mesh& mesh)
{
  while (!canGrow(mesh))
  {
    const VertexIndex v = atLongestBoundaryEdge(mesh);
    if (v == NoVertex || !mesh.canSplit(v, 0, 1))
    {
      return;
    }
    mesh.split(v, 0, 1, 0.5f * (mesh.position(v) + mesh.position(mesh.ring(v).front())));
  }
}
}

Mesh buildMesh(TriangleMesh triangles, const PointCloud& cloud)
{
  if (triangles.triangles.empty())
  {
    throw std::runtime_error("there are no triangles");
  }
  requirePoints(triangles, cloud);
  for (;;)
  {
    const TriangleFans fans(triangles);
    if (!splitLongFans(triangles, fans))
    {
      Mesh mesh = meshOf(triangles, fans, cloud);
      splitBoundaryUntilItGrows(mesh);
      return mesh;
    }
  }
}

TriangleMesh trianglesOf(const Mesh& mesh, const PointCloud& cloud, const Executor& executor)
{
  constexpr std::size_t PointsPerRange = 4096;
  TriangleMesh result{ std::vector<Eigen::Vector3d>(mesh.indexEnd()),
    triangleList(mesh, executor) };
  forEachVertex(mesh, executor, PointsPerRange,
    [&](VertexIndex v) { result.points[v] = cloud.toInput(mesh.position(v)); });
  return result;
}
}
