// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/Reconstruction.h"
#include "run/Tuning.h"

#include <functional>
#include <optional>

namespace neuralmesh
{
/// A run for whose cloud parameters are chosen first.
struct AutomaticReconstruction
{
  /// What was chosen; if that was ended, the parameters that were wanted, and the run ends, too.
  Tuning tuning;
  Reconstruction reconstruction;
};

/// Chooses parameters by tune(), which takes about a third of the run, calls `chosen`, and goes on as
/// reconstruct() does with them.
AutomaticReconstruction reconstructAutomatically(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const std::function<void(const Tuning&)>& chosen = {},
  const std::optional<Mesh>& first = {}, const GrowthWatch& watch = {}, CheckpointPlan plan = {},
  const Executor& executor = Executor::sequential(), const OrientationHints& hints = {},
  bool explainsAll = false);
}
