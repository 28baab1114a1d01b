// SPDX-License-Identifier: BSD-3-Clause
#include "learn/TopologyLearning.h"

#include "learn/TriangleRemoval.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryMerging.h"
#include "mesh/TriangleShape.h"

#include <cmath>

namespace neuralmesh
{
namespace
{
/// Below, a mesh is not torn.
constexpr std::size_t LeastVertices = 20;
/// Up to this size tearing is undone where it has taken most of the mesh; beyond, so much never
/// hangs on a few triangles.
constexpr std::size_t VerticesOfSmallMesh = 1000;
constexpr double LeastPartLeft = 0.5;
}

TopologyLearning::TopologyLearning(const Parameters& parameters)
  : parameters_(parameters)
{
}

TopologyLearning::Result TopologyLearning::apply(Mesh& mesh, BoundaryManager& boundaries) const
{
  Result result;
  const double meanArea = meanTriangleArea(mesh);
  const double largestArea = parameters_.triangleRemovalFactor * meanArea;
  const double mergingLimit = parameters_.boundaryMergingFactor * std::sqrt(meanArea);
  if (mesh.vertexCount() >= LeastVertices)
  {
    const auto size = isMended() ? TriangleSize::LongestEdge : TriangleSize::Area;
    removeTriangles(mesh, boundaries, findLargeTriangles(mesh, largestArea, size), result);
  }
  result.mergedBoundaries = mergeBoundaries(
    mesh, boundaries, mergingLimit, isMended() ? LoopDistance::Mean : LoopDistance::Hausdorff);
  if (isMended())
  {
    const double longestEdge = std::sqrt(largestArea / EquilateralArea);
    result.filledBoundaries = fillBoundaries(mesh, boundaries, longestEdge);
  }
  return result;
}

bool TopologyLearning::canRemoveStar(const Mesh& mesh, VertexIndex v) const
{
  return isMended() && mesh.isBoundary(v) && mesh.vertexCount() >= LeastVertices;
}

TopologyLearning::Result TopologyLearning::removeStar(
  Mesh& mesh, BoundaryManager& boundaries, VertexIndex v) const
{
  Result result;
  removeTriangles(mesh, boundaries, trianglesAt(mesh, v), result);
  return result;
}

void TopologyLearning::removeTriangles(
  Mesh& mesh, BoundaryManager& boundaries, std::span<const Triangle> triangles, Result& result)
{
  if (triangles.empty())
  {
    return;
  }
  const bool isSmall = mesh.vertexCount() <= VerticesOfSmallMesh;
  const Mesh before = isSmall ? mesh : Mesh();
  const Mesh::Removal removal = mesh.removeTriangles(triangles);
  if (isSmall && double(mesh.vertexCount()) < LeastPartLeft * double(before.vertexCount()))
  {
    mesh = before;
    return;
  }
  boundaries.retrace(mesh, removal.vertices);
  result.removedTriangles = removal.triangleCount;
  for (const VertexIndex v : removal.vertices)
  {
    if (!mesh.isAlive(v))
    {
      result.removedVertices.push_back(v);
    }
  }
}
}
