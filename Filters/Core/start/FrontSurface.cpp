// SPDX-License-Identifier: BSD-3-Clause
#include "start/FrontSurface.h"

#include "base/DisjointSets.h"
#include "cloud/MeshBuilder.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/CrossingRemoval.h"
#include "mesh/FanSplitting.h"
#include "mesh/SelfIntersections.h"
#include "start/AdvancingFront.h"
#include "start/WideTriangles.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A piece with less is none, however few there are; unless all are to be kept.
constexpr std::size_t LeastTriangles = 12;
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
}

std::optional<FrontSurface> frontSurface(const PointCloud& cloud, const NearestPoints& nearest,
  std::size_t count, Layers layers, std::uint64_t seed, const Progress& progress, double leastPiece,
  double mostScatter)
{
  const auto [samples, inNoLayer, inOneOfTwo] =
    layerSamples(nearest, count, layers, seed, partOf(progress, 0., PartOfSamples), mostScatter);
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
  result.crossings = intersectingPairs(result.mesh).size();
  if (result.crossings > 0)
  {
    replaceCrossings(result.mesh, Crossings::All);
  }
  result.mesh.removeTriangles(findWideTriangles(result.mesh, samples));
  fillSmallGaps(result.mesh);
  if (layers == Layers::Apart)
  {
    // Along the rims of plates.
    fillSlits(result.mesh, samples);
  }
  removeCrossings(result.mesh);
  // What it has opened: a few triangles that intersect come apart in learning, a hole would stay.
  fillSmallGaps(result.mesh);
  result.mesh.dropErased();
  return result;
}
}
