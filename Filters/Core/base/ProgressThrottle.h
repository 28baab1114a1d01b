// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace neuralmesh
{
/// Tells which reports of progress are worth passing on: those in steps of a hundredth, and one every 50
/// milliseconds, for whoever wants to end a run does so when told of progress.
class ProgressThrottle
{
public:
  /// Whether a report is due; then the next ones count from it.
  bool isDue(double fraction)
  {
    const Clock::time_point now = Clock::now();
    if (fraction < fraction_ + Step && now < time_ + Interval)
    {
      return false;
    }
    fraction_ = fraction;
    time_ = now;
    return true;
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr double Step = 0.01;
  static constexpr std::chrono::milliseconds Interval{ 50 };

  double fraction_ = 0.;
  Clock::time_point time_ = Clock::now();
};
}
