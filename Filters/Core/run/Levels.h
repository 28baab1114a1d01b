// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail: several meshes of a cloud in one run, with ascending numbers of vertices.
#pragma once

#include "base/Progress.h"
#include "run/Reconstruction.h"
#include "run/Run.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace neuralmesh
{
/// Other requests that levels exclude.
struct BesideLevels
{
  bool firstMesh = false;
  bool checkpoint = false;
  bool snapshots = false;
  bool automatic = false;
};

/// The reason why a run with these levels is impossible, as a sentence; empty if it is possible.
std::string whyNoLevels(std::span<const std::uint64_t> levels, const Parameters& parameters,
  const BesideLevels& beside = {});

/// Receives each level except the last one, with its index, in ascending order.
using LevelTaker = std::function<void(std::size_t level, Reconstruction mesh)>;

/// Makes the largest level, and simplifies it to the others, one after the other; each is fitted. On a closed surface with
/// noise, one mesh grows to the smaller levels instead, and a copy of it is finished at each: it is more even, so that
/// noise averages better. So it is, with all levels, without a fit or with feature strength. Each level is about as good
/// as a run of its own. `levels` ascend. `take` receives each of them; the last one is returned. If `progress` ends the
/// run early, it returns the level that it has reached, and smaller ones may be missing. whyNoLevels() must be empty.
Reconstruction reconstructLevels(const RunRequest& request, std::span<const std::uint64_t> levels,
  const LevelTaker& take, const Progress& progress);
}
