// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
class Archive;

/// The vertices in the order of their activity: which one to split, which to remove. What counts
/// as activity (wins, changes of the normal) is told by the gain of a win.
class ActivityOrder
{
public:
  virtual ~ActivityOrder() = default;

  /// An iteration in which `winner` won, worth `gain`, (6.5) or (8.3), before which all activities
  /// decayed by `decay`, (6.6), (8.4) or (9.4).
  virtual void win(VertexIndex winner, double gain, double decay) = 0;
  /// Brings into the cache what a win of `winner` will need.
  virtual void prefetch(VertexIndex winner) const = 0;
  /// An iteration without a winner.
  virtual void pass(double decay) = 0;

  /// The most active vertex; of equally active ones the lowest index.
  virtual VertexIndex top() const = 0;
  /// The laziest vertex; of equally lazy ones the lowest index.
  virtual VertexIndex bottom() = 0;
  /// Whether the laziest vertex has less activity than `threshold` times that of one win, as
  /// `expectedCount` vertices have on average.
  virtual bool isBottomBelow(double threshold, double expectedCount) = 0;

  /// `added` came out of a split of `split`, which keeps `share` (0 ... 1) of its activity; the
  /// rest is that of `added`. (6.19)
  virtual void split(VertexIndex split, VertexIndex added, double share) = 0;
  virtual void erase(VertexIndex v) = 0;
  /// The most active vertex cannot be split: lowers it, so that others get their turn.
  virtual void demoteTop() = 0;
  /// The laziest vertex cannot be removed: raises it, so that others get their turn.
  virtual void promoteBottom() = 0;

  /// The activity in units of one win, as far as the number range goes; in a list, the place in it.
  virtual double activity(VertexIndex v) const = 0;

  /// Memory for `count` indices: up to there no operation allocates.
  virtual void reserve(std::size_t count) = 0;
  /// As Mesh::renumber().
  virtual void renumber(std::span<const VertexIndex> permutation) = 0;

  /// Writes the order of the `vertices`, or reads it: which ones there are is known by the mesh.
  virtual void exchange(Archive& archive, std::span<const VertexIndex> vertices) = 0;
};
}
