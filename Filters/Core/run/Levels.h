// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail: several meshes of a cloud, of more and more vertices, in one run.
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
/// What else a run may be asked for that levels exclude.
struct BesideLevels
{
  bool firstMesh = false;
  bool checkpoint = false;
  bool snapshots = false;
  bool automatic = false;
};

/// Why there is no run with such levels, as a sentence; empty if there is.
std::string whyNoLevels(std::span<const std::uint64_t> levels, const Parameters& parameters,
  const BesideLevels& beside = {});

/// Told of each level but the last, with its place among all. A level that may have lost thin parts comes after the
/// others.
using LevelTaker = std::function<void(std::size_t level, Reconstruction mesh)>;

/// Grows one mesh and finishes a copy of it whenever it has as many vertices as a level, so that each level
/// is as good as a run of its own, and all start and learn in little more time than the largest. `levels`
/// ascend; each is given to `take`, the last one is returned. A run that ends early, by a rule or its
/// caller, ends with the level that it is at. There must be such a run, see whyNoLevels().
Reconstruction reconstructLevels(const RunRequest& request, std::span<const std::uint64_t> levels,
  const LevelTaker& take, const Progress& progress);
}
