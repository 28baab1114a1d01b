// SPDX-License-Identifier: BSD-3-Clause
#include "start/FrontSurface.h"

#include "base/DisjointSets.h"
#include "cloud/MeshBuilder.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/CrossingRemoval.h"
#include "mesh/FanSplitting.h"
#include "mesh/SelfIntersections.h"
#include "mesh/TurnedParts.h"
#include "mesh/TwistedParts.h"
#include "start/AdvancingFront.h"
#include "start/WideTriangles.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A piece with less is none, however few there are; unless all are to be kept.
constexpr std::size_t LeastTriangles = 12;
/// So near to a point lies what fills a cut.
constexpr double PartOfEdge = 1.0;
// Of the time.
constexpr double PartOfSamples = 0.7;
constexpr double PartOfLayers = 0.9;

void dropSmallPieces(TriangleMesh& mesh, double leastPiece)
{
  DisjointSets sets(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::vector<std::size_t> sizes(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles)
  {
    ++sizes[sets.root(triangle[0])];
  }
  const std::size_t least = leastPiece > 0.
    ? std::max(LeastTriangles, std::size_t(leastPiece * double(mesh.triangles.size())))
    : 0;
  std::erase_if(
    mesh.triangles, [&](const auto& triangle) { return sizes[sets.root(triangle[0])] < least; });
}

/// The holes that were cut into the layers of parts that hung together: there are points on what fills them.
void fillCuts(Mesh& mesh, const NearestPoints& nearest)
{
  const double most = PartOfEdge * mesh.meanEdge();
  BoundaryManager boundaries(mesh);
  fillBoundaries(
    mesh, boundaries, std::numeric_limits<double>::max(),
    [&](const Triangle& triangle)
    {
      const Vector4 center = 1.f / 3.f *
        (mesh.position(triangle[0]) + mesh.position(triangle[1]) + mesh.position(triangle[2]));
      std::array<NearPoint, 1> closest;
      nearest.find(center, closest);
      return double(closest[0].squaredDistance) <= most * most;
    },
    std::numeric_limits<std::size_t>::max(), CosineOfOutline);
}
}

std::optional<FrontSurface> frontSurface(const PointCloud& cloud, PointLayers& pointLayers,
  Layers layers, std::uint64_t seed, const Progress& progress, double leastPiece,
  double mostScatter)
{
  const auto [samples, inNoLayer, inOneOfTwo] =
    layerSamples(pointLayers, layers, seed, partOf(progress, 0., PartOfSamples), mostScatter);
  if (samples.empty() || !progress(PartOfSamples))
  {
    return {};
  }
  TriangleMesh triangles;
  triangles.points.reserve(samples.size());
  for (const LayerSample& sample : samples)
  {
    triangles.points.push_back(cloud.toInput(sample.position));
  }
  triangles.triangles = advancingFront(samples, layers);
  if (!progress(PartOfLayers))
  {
    return {};
  }
  splitFans(triangles);
  const std::size_t turnedParts = separateTurnedParts(triangles);
  if (turnedParts > 0)
  {
    splitFans(triangles);
  }
  dropSmallPieces(triangles, leastPiece);
  if (triangles.triangles.empty())
  {
    return {};
  }
  FrontSurface result;
  result.mesh = buildMesh(std::move(triangles), cloud);
  result.samples = samples.size();
  result.inOneOfTwo = inOneOfTwo;
  result.scatter = double(inNoLayer) / double(samples.size() + inNoLayer);
  result.filledLoops = fillSmallGaps(result.mesh);
  const std::vector<TrianglePair> pairs = intersectingPairs(result.mesh);
  result.crossings = pairs.size();
  if (result.crossings > 0)
  {
    replaceCrossings(result.mesh, pairs);
  }
  result.mesh.removeTriangles(findWideTriangles(result.mesh, samples));
  // What is left intersects nothing but what is filled from here on.
  const std::vector<bool> isOnBoundary = findBoundaryVertices(result.mesh);
  fillSmallGaps(result.mesh);
  if (turnedParts > 0)
  {
    fillCuts(result.mesh, pointLayers.nearest());
  }
  if (layers == Layers::Apart)
  {
    // Along the rims of plates.
    fillSlits(result.mesh, samples);
  }
  removeCrossings(result.mesh, isOnBoundary);
  // What it has opened: a few triangles that intersect come apart in learning, a hole would stay.
  fillSmallGaps(result.mesh);
  result.mesh.dropErased();
  if (separateTwistedParts(result.mesh) > 0)
  {
    result.mesh.dropErased();
  }
  return result;
}
}
