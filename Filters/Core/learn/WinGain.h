// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/MovingStatistics.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>

namespace neuralmesh
{
/// What a win is worth to the activity of the winner: 1, or what its move changes over what moves
/// change on average, n_delta of (8.2), or a mean of such figures (11.2.1).
///
/// The averages are over the last so many observed moves. They stay as they are during a batch of
/// samples, which comes sorted: else each corner of the cloud would be measured by itself.
class WinGain
{
public:
  /// Gains of the variant, for counters.
  explicit WinGain(const Parameters& parameters);

  /// From now on gains by which to jump in the activity list.
  void enterList();

  /// Before each batch, of which every so-many-th move is observed.
  void beginBatch(std::size_t stride);

  /// Whether the move of an iteration must be measured: each where gains differ, else one now and
  /// then, for the learning curve. The gain of all others is 1.
  bool isDue(std::uint64_t iteration) const { return (iteration & iterationMask_) == 0; }
  /// The gain of a winner that is to move to `position`.
  double ofMove(const Mesh& mesh, VertexIndex winner, Vector4 position);

  /// n_delta of the last move, where feature strength is asked for.
  double normalGain() const { return normalGain_; }
  /// Changes of the winner's normal, delta_w of (8.1).
  const MovingStatistics& normalChanges() const { return normal_.changes; }

  /// Between two batches. Whether gains are those of the list is for the learner to say.
  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(normal_.changes, area_.changes, volume_.changes);
    archive(untilObservation_);
  }

private:
  /// How much moves change something, and its part in the gain.
  struct RelativeChange
  {
    MovingStatistics changes;
    double weight = 0.;
    double mean = 0.;
  };

  void setWeights(double constant, double normal, double area, double volume);
  /// The change over its mean.
  double relative(RelativeChange& relativeChange, double change, bool isObserved) const;

  Parameters parameters_;
  double constantWeight_ = 1.;
  RelativeChange normal_;
  RelativeChange area_;
  RelativeChange volume_;
  double normalGain_ = 1.;
  std::uint64_t iterationMask_ = 0;
  std::size_t stride_ = 1;
  std::size_t untilObservation_ = 0;
};
}
