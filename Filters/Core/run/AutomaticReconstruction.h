// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/Reconstruction.h"
#include "run/Tuning.h"

#include <functional>
#include <optional>

namespace neuralmesh
{
/// A run that first chooses parameters for its cloud.
struct AutomaticReconstruction
{
  /// The chosen parameters. If `progress` ended the choice, the given parameters, and the run ends,
  /// too.
  Tuning tuning;
  Reconstruction reconstruction;
};

/// Chooses parameters by tune(), which takes about a third of the run, calls `chosen`, and
/// reconstructs with them.
AutomaticReconstruction reconstructAutomatically(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const std::function<void(const Tuning&)>& chosen = {},
  const std::optional<Mesh>& first = {}, const GrowthWatch& watch = {}, CheckpointPlan plan = {},
  const Executor& executor = Executor::sequential(), const OrientationHints& hints = {},
  bool explainsAll = false);
}
