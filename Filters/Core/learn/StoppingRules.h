// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Learner.h"

#include <chrono>
#include <string_view>

namespace neuralmesh
{
class Archive;

enum class StopReason
{
  None,           ///< still learning
  Vertices,       ///< as many as were asked for
  Iterations,     ///< the most that were allowed
  SampleDistance, ///< mean |s - v_w| is small enough
  CloudDistance,  ///< mean distance from P to M is small enough
  NormalChange,   ///< mean change of the winner's normal is small enough
  TimeLimit,      ///< the time is over
  Stalled,        ///< the mesh has stopped growing
  Cancelled       ///< by the caller
};

std::string_view name(StopReason reason);

/// Whether a rule may end a run before its mesh has all of its vertices.
bool mayEndBeforeVertices(const Parameters& parameters);

/// When to end a run: whichever rule is met first.
class StoppingRules
{
public:
  /// Progress counts from a mesh of so many vertices on.
  StoppingRules(
    const PointCloud& cloud, const Parameters& parameters, std::size_t firstVertices = 0);

  /// The rule that the learner meets now, or None. To be asked after every batch.
  StopReason check(const Learner& learner);
  /// How much of the run is done, 0 to 1, by the rule that is closest to being met; never falls.
  double progress(const Learner& learner);
  /// Since the start of the run.
  double seconds() const;

  /// With the seconds so far: those in between do not count.
  void exchange(Archive& archive);

private:
  using Clock = std::chrono::steady_clock;

  /// Samples that growth to so many vertices takes, up to a factor.
  double samplesUntil(std::size_t vertices) const;
  bool meetsCloudDistance(const Learner& learner);

  const PointCloud& cloud_;
  Parameters parameters_;
  std::size_t firstVertices_;
  Clock::time_point start_ = Clock::now();
  std::size_t mostVertices_ = 0;
  std::uint64_t lastGrowth_ = 0;
  std::size_t nextCloudDistance_;
  double samplesAfterGrowth_ = 0.;
  double progress_ = 0.;
};
}
