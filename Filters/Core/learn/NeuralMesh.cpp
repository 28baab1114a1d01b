// SPDX-License-Identifier: BSD-3-Clause
#include "learn/NeuralMesh.h"

#include "base/Archive.h"
#include "mesh/EdgeFlips.h"
#include "mesh/HalfEdgeCollapse.h"
#include "mesh/MortonPermutation.h"
#include "mesh/VertexRemoval.h"

#include <algorithm>
#include <cassert>

namespace neuralmesh
{
namespace
{
constexpr std::size_t PrefetchDistance = 8;
/// Meshes up to this size stay in the nearer cache by themselves, more or less; up to that size in
/// the next one.
constexpr std::size_t VerticesInNearCache = 1 << 12;
constexpr std::size_t VerticesInCache = 1 << 15;

/// Width of a grid cell in mean edges.
constexpr float EdgesPerCell = 2.f;
/// Vertices are renumbered and the grid is made anew whenever there are so many times more.
constexpr double GrowthUntilRenumbering = 1.4;
/// Beyond this part of all vertices only the grid is made anew: the copies that renumbering takes
/// would be the most memory of the run.
constexpr double LastRenumbering = 0.7;
/// More than all vertices: those that a batch adds before the ones it removes are used again.
constexpr double RoomBeyondAll = 1.03;
}

NeuralMesh::NeuralMesh(Mesh mesh, std::unique_ptr<ActivityOrder> order, Vector4 boxMin,
  Vector4 boxMax, std::size_t mostVertices, const Executor& executor)
  : mesh_(std::move(mesh))
  , order_(std::move(order))
  , boxMin_(boxMin)
  , boxMax_(boxMax)
  , mostVertices_(mostVertices)
{
  // Those of another learner: a checkpoint would hold them only where learning began from its mesh.
  mesh_.dropProperties();
  compact(executor);
}

std::vector<VertexIndex> NeuralMesh::vertices() const
{
  std::vector<VertexIndex> result;
  result.reserve(mesh_.vertexCount());
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    if (mesh_.isAlive(v))
    {
      result.push_back(v);
    }
  }
  return result;
}

// --- Basic step ----------------------------------------------------------------------------------

void NeuralMesh::prefetchBehind(std::size_t sample, std::span<const VertexIndex> winners) const
{
  if (vertexCount() <= VerticesInNearCache || sample + PrefetchDistance >= winners.size())
  {
    return;
  }
  const Vector4* positions = mesh_.positions().data();
  const auto winnerIn = [&](std::size_t samples) { return winners[sample + samples]; };
  __builtin_prefetch(&mesh_.ring(winnerIn(PrefetchDistance)));
  order_->prefetch(winnerIn(PrefetchDistance / 2));
  for (const VertexIndex neighbor : mesh_.ring(winnerIn(PrefetchDistance / 2)))
  {
    __builtin_prefetch(&mesh_.ring(neighbor));
    __builtin_prefetch(positions + neighbor);
  }
  if (vertexCount() > VerticesInCache)
  {
    // Smoothing looks at the neighbours of the neighbours: two of each stand for those beside them.
    for (const VertexIndex neighbor : mesh_.ring(winnerIn(PrefetchDistance / 4)))
    {
      const Ring& ring = mesh_.ring(neighbor);
      __builtin_prefetch(positions + ring[0]);
      __builtin_prefetch(positions + ring[ring.size() / 2]);
    }
  }
}

void NeuralMesh::smoothRing(VertexIndex v, float rate, BoundarySmoothing onBoundary)
{
  const Ring& ring = mesh_.ring(v);
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    smoothedPositions_[slot] = smoothedPosition(mesh_, ring[slot], rate, onBoundary);
  }
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    move(ring[slot], smoothedPositions_[slot]);
  }
}

// --- Growth --------------------------------------------------------------------------------------

VertexIndex NeuralMesh::split(VertexIndex v, const VertexSplit& plan)
{
  const VertexIndex added = mesh_.split(v, plan.first, plan.steps, plan.position);
  grid_.insert(added, plan.position);
  if (boundaries_)
  {
    boundaries_->split(v, added);
  }
  order_->split(v, added, shareOfSplit(mesh_, v, added));
  return added;
}

unsigned NeuralMesh::flipEdgesAround(VertexIndex v)
{
  return neuralmesh::flipEdgesAround(mesh_, v);
}

VertexIndex NeuralMesh::planCollapse(VertexIndex v) const { return bestCollapse(mesh_, v); }

void NeuralMesh::collapse(VertexIndex removed, VertexIndex kept)
{
  if (boundaries_)
  {
    boundaries_->collapse(removed, kept);
  }
  mesh_.collapse(removed, kept);
  erase(std::span(&removed, 1));
}

unsigned NeuralMesh::triangulateAnew(const Ring& polygon, VertexIndex kept)
{
  return neuralmesh::triangulateAnew(mesh_, polygon, kept);
}

TopologyLearning::Result NeuralMesh::learnTopology(const TopologyLearning& rules)
{
  assert(boundaries_);
  TopologyLearning::Result result = rules.apply(mesh_, *boundaries_);
  erase(result.removedVertices);
  return result;
}

TopologyLearning::Result NeuralMesh::removeStar(VertexIndex v, const TopologyLearning& rules)
{
  assert(boundaries_);
  TopologyLearning::Result result = rules.removeStar(mesh_, *boundaries_, v);
  erase(result.removedVertices);
  return result;
}

/// What the mesh has erased is erased from order and grid.
void NeuralMesh::erase(std::span<const VertexIndex> removed)
{
  for (const VertexIndex v : removed)
  {
    grid_.erase(v, mesh_.position(v));
    order_->erase(v);
  }
}

// --- Order and memory ----------------------------------------------------------------------------

void NeuralMesh::replaceOrder(const MakeOrder& make)
{
  std::vector<VertexIndex> laziestFirst(vertexCount());
  for (VertexIndex& v : laziestFirst)
  {
    v = order_->bottom();
    order_->erase(v);
  }
  order_ = make(laziestFirst);
  order_->reserve(capacity_);
}

void NeuralMesh::compact(const Executor& executor)
{
  const std::vector<VertexIndex> permutation = mortonPermutation(mesh_, boxMin_, boxMax_, executor);
  mesh_.renumber(permutation);
  order_->renumber(permutation);
  if (boundaries_)
  {
    boundaries_->renumber(permutation);
  }
  nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * double(permutation.size()));
  reserve();
  makeGrid();
}

void NeuralMesh::compactIfGrown(const Executor& executor)
{
  if (vertexCount() < nextRenumbering_)
  {
    return;
  }
  const auto count = double(vertexCount());
  if (count <= LastRenumbering * double(mostVertices_))
  {
    compact(executor);
    return;
  }
  nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * count);
  makeGrid();
}

/// Memory up to the next renumbering, and for what a batch may add beyond.
void NeuralMesh::reserve()
{
  const double all = RoomBeyondAll * double(mostVertices_);
  const double next = 1.1 * double(nextRenumbering_);
  const double most = std::max(all, double(mesh_.indexEnd()));
  capacity_ = 64 + std::size_t(std::min(next, most));
  mesh_.reserve(capacity_);
  order_->reserve(capacity_);
}

void NeuralMesh::makeGrid()
{
  grid_.reset(boxMin_, boxMax_, EdgesPerCell * float(mesh_.meanEdge()), capacity_);
  for (const VertexIndex v : vertices())
  {
    grid_.insert(v, mesh_.position(v));
  }
}

void NeuralMesh::exchange(Archive& archive)
{
  archive(mesh_);
  archive.require(vertexCount() > 0);
  order_->exchange(archive, vertices());
  if (boundaries_)
  {
    boundaries_->exchange(archive, mesh_);
  }
  archive(nextRenumbering_);
  archive.require(
    double(nextRenumbering_) <= 1. + GrowthUntilRenumbering * double(mesh_.indexEnd()));
  if (archive.isReading())
  {
    // What follows from the rest.
    reserve();
    makeGrid();
  }
}
}
