// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <ctime>
#include <optional>

namespace neuralmesh
{
/// What a run does, one after the other.
enum class Phase
{
  Drawing,  ///< of points from a file
  Cloud,    ///< the points are made ready
  Choice,   ///< of parameters
  Start,    ///< the first surface
  Learning, ///< up to a stopping rule
  Finish    ///< fit, repair, description
};

/// CPU seconds of the process in the phases of a run, on all threads.
class PhaseTimes
{
public:
  /// Ends the phase before, if there was one.
  void enter(Phase phase)
  {
    leave();
    phase_ = phase;
  }
  void leave()
  {
    const std::clock_t now = std::clock();
    if (phase_)
    {
      seconds_[std::size_t(*phase_)] += double(now - begin_) / CLOCKS_PER_SEC;
    }
    phase_.reset();
    begin_ = now;
  }

  double seconds(Phase phase) const { return seconds_[std::size_t(phase)]; }

  /// Adds the phases of a part of this run.
  void add(const PhaseTimes& part)
  {
    for (std::size_t i = 0; i < seconds_.size(); ++i)
    {
      seconds_[i] += part.seconds_[i];
    }
  }

private:
  std::array<double, std::size_t(Phase::Finish) + 1> seconds_{};
  std::optional<Phase> phase_;
  std::clock_t begin_ = 0;
};
}
