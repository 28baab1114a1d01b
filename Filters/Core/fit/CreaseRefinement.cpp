// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CreaseRefinement.h"

#include "base/InterruptibleExecutor.h"
#include "mesh/BrokenMoves.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"
#include "mesh/StoredMesh.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
/// An edge belongs to a crease if the cosine between the normals beside it is smaller.
constexpr float CosineOfCrease = 0.6f;
/// Number of rounds in which the vertices move.
constexpr int Rounds = 2;
/// A part for the executor.
constexpr std::size_t VerticesOfCreasePart = 4096;

/// Calls `body` with the ends of each edge, once.
template <typename Body>
void forEachEdge(const Mesh& mesh, const Body& body)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex other : mesh.ring(v))
    {
      if (v < other)
      {
        body(v, other);
      }
    }
  }
}

bool isOfCrease(const Mesh& mesh, VertexIndex a, VertexIndex b)
{
  if (mesh.isBoundaryEdge(a, b))
  {
    return false;
  }
  const Edge opposite = oppositeTo(mesh, { a, b });
  const Vector4 from = mesh.position(a), edge = mesh.position(b) - from;
  const Vector4 left = cross(edge, mesh.position(opposite[0]) - from);
  const Vector4 right = cross(mesh.position(opposite[1]) - from, edge);
  return cosineBetween(left, right) < CosineOfCrease;
}

std::vector<std::uint8_t> atEdgesThatAreNotFlat(const Mesh& mesh)
{
  std::vector<std::uint8_t> isAtCrease(mesh.indexEnd());
  forEachEdge(mesh,
    [&](VertexIndex a, VertexIndex b)
    {
      if (!isFlatEdge(mesh, a, b))
      {
        isAtCrease[a] = isAtCrease[b] = 1;
      }
    });
  std::vector<std::uint8_t> result = isAtCrease;
  forEachEdge(mesh,
    [&](VertexIndex a, VertexIndex b)
    {
      result[a] |= isAtCrease[b];
      result[b] |= isAtCrease[a];
    });
  return result;
}

bool refineAndFit(const PointCloud& cloud, const StoredMesh& before, Mesh& mesh, std::size_t count,
  double samplesPerVertex, FinishReport& report, const Executor& executor, const Progress& progress)
{
  const auto defects = [&]
  {
    return DefectCount{ intersectingTriangles(mesh, executor).size(),
      foldedEdges(mesh, executor).size() };
  };
  if (!refine(mesh, count, partOf(progress, 0., 0.2), EdgesAfterSplit::FlipFlat))
  {
    return false;
  }
  flipEdges(mesh, EdgesToFlip::Flat, executor);
  SurfaceFit fit(cloud, mesh, std::size_t(samplesPerVertex * double(count)), executor);
  fit.settle();
  fit.findExactly();
  fit.keepBoundaries();
  fit.keep(atEdgesThatAreNotFlat(mesh));
  for (int round = 0; round < Rounds; ++round)
  {
    const Progress part = partOf(progress, 0.2 + 0.4 * round, 0.6 + 0.4 * round);
    PackedVectors places;
    if (!fit.findPlaces(partOf(part, 0., 0.5)) ||
      !fit.moveVertices(report.smoothness, partOf(part, 0.5, 1.), places) ||
      takeBackBrokenMoves(mesh, places, partOf(part, 1., 1.), executor) ==
        AfterBrokenMoves::Cancelled)
    {
      return false;
    }
  }
  const DefectCount left = defects();
  if (left.total() <= report.left.total())
  {
    report.left = left;
    report.heldVertices += fit.heldCount();
    return true;
  }
  // The fallback is the same surface with more vertices.
  mesh = before.mesh(executor);
  const bool isDone = refine(mesh, count, partOf(progress, 1., 1.), EdgesAfterSplit::Keep);
  report.left = defects();
  return isDone;
}
}

double creaseWidths(const Mesh& mesh, const Executor& executor)
{
  const double count = executor.sum(mesh.indexEnd(), VerticesOfCreasePart,
    [&](std::size_t v)
    {
      const Ring& ring = mesh.ring(VertexIndex(v));
      return std::count_if(ring.begin(), ring.end(),
        [&](VertexIndex other) { return v < other && isOfCrease(mesh, VertexIndex(v), other); });
    });
  return count / std::sqrt(double(mesh.vertexCount()));
}

bool hasCreases(const Mesh& mesh, const Executor& executor)
{
  return creaseWidths(mesh, executor) > WidthsOfCreases;
}

bool refineBesideCreases(const PointCloud& cloud, Mesh& mesh, std::size_t count,
  double samplesPerVertex, FinishReport& report, const Executor& executor, const Progress& progress)
{
  const StoredMesh before(mesh, executor.uninterrupted());
  try
  {
    return refineAndFit(cloud, before, mesh, count, samplesPerVertex, report, executor, progress);
  }
  catch (const Interrupted&)
  {
    mesh = before.mesh(executor);
    return false;
  }
}
}
