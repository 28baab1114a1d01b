// SPDX-License-Identifier: BSD-3-Clause
// Runs that find out themselves how many vertices their mesh is to have.
#pragma once

#include "base/Progress.h"
#include "run/Run.h"
#include "run/SizeChoice.h"

namespace neuralmesh
{
/// A run whose mesh has as many vertices as the points support, or as few as meet a tolerance. The
/// number of vertices of the parameters does not count. Small meshes are made and measured first, and what they tell
/// is checked in the end; the result has a `size`, unless the run was ended before. There must be such a run, see
/// whyNoSize() and whyNoSizeFor().
Reconstruction reconstructSized(
  const RunRequest& request, const SizeGoal& goal, const Progress& progress);
}
