// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/VertexGrid.h"
#include "learn/ActivityOrder.h"
#include "learn/TopologyLearning.h"
#include "mesh/BoundaryManager.h"
#include "mesh/Mesh.h"
#include "mesh/Smoothing.h"
#include "mesh/VertexSplit.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
class Archive;

/// The Neural Mesh as one: the mesh M, the order L of its vertices by their activity, the access A to
/// the vertex that is closest to a sample, and the boundaries of M. After each call all of them
/// agree, and so do the properties of the vertices.
///
/// An operation is planned first (`plan...` changes nothing) and carried out then. A plan holds as
/// long as the rings of the vertices in it stay as they are, so operations that lie apart can be
/// planned side by side.
class NeuralMesh
{
public:
  /// `order` holds the vertices of `mesh`, which are compacted. Memory is taken for growth to
  /// `mostVertices`. A searches fastest in the box, which need not hold all vertices.
  NeuralMesh(Mesh mesh, std::unique_ptr<ActivityOrder> order, Vector4 boxMin, Vector4 boxMax,
    std::size_t mostVertices, const Executor& executor = Executor::sequential());

  const Mesh& mesh() const { return mesh_; }
  const ActivityOrder& order() const { return *order_; }
  const VertexGrid& grid() const { return grid_; }
  std::size_t vertexCount() const { return mesh_.vertexCount(); }
  /// In the order of their indices.
  std::vector<VertexIndex> vertices() const;

  /// A value for each vertex, which follows all operations. All vertices begin with `first`.
  template <typename T>
  VertexProperty<T> addProperty(T first, OnSplit onSplit)
  {
    return mesh_.addProperty(first, onSplit);
  }
  template <typename T>
  std::span<T> values(VertexProperty<T> property)
  {
    return mesh_.values(property);
  }

  // Basic step

  /// v_w: the vertex closest to a sample.
  VertexIndex winner(Vector4 sample) const { return grid_.closest(sample, mesh_.positions()); }
  /// Those of many samples, which lie side by side in space.
  void findWinners(std::span<const Vector4> samples, std::span<VertexIndex> winners,
    const Executor& executor) const
  {
    grid_.closest(samples, mesh_.positions(), winners, executor);
  }
  /// Brings into the cache what winners a few places behind `sample` will need.
  void prefetchBehind(std::size_t sample, std::span<const VertexIndex> winners) const;

  void move(VertexIndex v, Vector4 position)
  {
    grid_.move(v, mesh_.position(v), position);
    mesh_.setPosition(v, position);
  }
  /// Smooths the neighbours of `v`, (6.2) to (6.4), all at once.
  void smoothRing(VertexIndex v, float rate, BoundarySmoothing onBoundary);
  /// `v` has won, (6.5) or (9.5), and all activities have decayed before by `decay`.
  void win(VertexIndex v, double gain, double decay) { order_->win(v, gain, decay); }
  /// Nobody has won, but all activities have decayed.
  void pass(double decay) { order_->pass(decay); }

  // Node Addition

  VertexIndex top() const { return order_->top(); }
  /// The top cannot be split: others get their turn.
  void demoteTop() { order_->demoteTop(); }
  /// Carries a split out. Both vertices share the activity by their areas, (6.19). Returns the new
  /// vertex.
  VertexIndex split(VertexIndex v, const VertexSplit& plan);
  /// Flips edges around `v` that way towards regular valences; returns how many.
  unsigned flipEdgesAround(VertexIndex v);

  // Node Removal

  VertexIndex bottom() { return order_->bottom(); }
  bool isBottomBelow(double threshold, double expectedCount)
  {
    return order_->isBottomBelow(threshold, expectedCount);
  }
  /// The bottom cannot be removed: others get their turn.
  void promoteBottom() { order_->promoteBottom(); }
  /// The neighbour into which `v` is to be collapsed, by (6.7) or (7.3); NoVertex if no collapse is
  /// legal.
  VertexIndex planCollapse(VertexIndex v) const;
  void collapse(VertexIndex removed, VertexIndex kept);
  /// Triangulates the former ring of a vertex that was collapsed into `kept` anew; returns the flips.
  unsigned triangulateAnew(const Ring& polygon, VertexIndex kept);

  // Topology learning (Algorithm 2)

  /// From now on boundaries are known, as the two calls below must have it.
  void traceBoundaries() { boundaries_.emplace(mesh_); }
  /// Removes large triangles, and merges and fills boundaries.
  TopologyLearning::Result learnTopology(const TopologyLearning& rules);
  /// Removes the triangles at `v`.
  TopologyLearning::Result removeStar(VertexIndex v, const TopologyLearning& rules);

  // Order and memory

  /// Goes on with the order that `make` makes of the vertices, which it is given from the laziest to
  /// the most active one.
  using MakeOrder =
    std::function<std::unique_ptr<ActivityOrder>(std::span<const VertexIndex> laziestFirst)>;
  void replaceOrder(const MakeOrder& make);
  /// All vertices move, and the box with them; the order stays.
  template <typename Move>
  void moveAll(Vector4 boxMin, Vector4 boxMax, Move move)
  {
    boxMin_ = boxMin;
    boxMax_ = boxMax;
    for (const VertexIndex v : vertices())
    {
      mesh_.setPosition(v, move(mesh_.position(v)));
    }
    makeGrid();
  }
  void setMostVertices(std::size_t count) { mostVertices_ = count; }
  /// Lets the indices of erased vertices be used again.
  void releaseErased() { mesh_.releaseErased(); }
  /// Gives the vertices indices in Morton order without gaps, everywhere: what lies side by side in
  /// space is to lie side by side in memory.
  void compact(const Executor& executor);
  /// Does so where the mesh has grown enough since the last time; towards the end of growth only A is
  /// made anew.
  void compactIfGrown(const Executor& executor);

  /// Writes all of it, or reads it into one that was made alike.
  void exchange(Archive& archive);

private:
  void erase(std::span<const VertexIndex> removed);
  void reserve();
  void makeGrid();

  Mesh mesh_;
  std::unique_ptr<ActivityOrder> order_;
  VertexGrid grid_;
  std::optional<BoundaryManager> boundaries_; ///< known only where topology is learnt
  Vector4 boxMin_;
  Vector4 boxMax_;
  std::size_t mostVertices_;
  std::size_t nextRenumbering_ = 0; ///< number of vertices
  std::size_t capacity_ = 0;        ///< indices for which there is memory
  std::array<Vector4, Ring::Capacity> smoothedPositions_;
};
}
