// SPDX-License-Identifier: BSD-3-Clause
#include "run/AutomaticReconstruction.h"

#include <utility>

namespace neuralmesh
{
namespace
{
/// The end of the choice of parameters, as a fraction of the run.
constexpr double EndOfChoice = 0.3;
}

AutomaticReconstruction reconstructAutomatically(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const std::function<void(const Tuning&)>& chosen,
  const std::optional<Mesh>& first, const GrowthWatch& watch, CheckpointPlan plan,
  const Executor& executor, const OrientationHints& hints, bool explainsAll)
{
  PhaseTimes times;
  times.enter(Phase::Choice);
  std::optional<Tuning> tuning = tune(cloud, wanted, partOf(progress, 0., EndOfChoice), executor);
  times.leave();
  plan.areParametersChosen = tuning.has_value();
  // If `progress` ends the choice, it ends the run, with the given parameters.
  AutomaticReconstruction result{ tuning ? *std::move(tuning) : Tuning{ wanted, {}, {}, {} }, {} };
  if (chosen)
  {
    chosen(result.tuning);
  }
  result.reconstruction = reconstruct(cloud, result.tuning.parameters,
    partOf(progress, EndOfChoice, 1.), first, watch, plan, executor, hints, explainsAll);
  result.reconstruction.times.add(times);
  return result;
}
}
