// SPDX-License-Identifier: BSD-3-Clause
// Runs that choose the number of vertices themselves.
#pragma once

#include "base/Progress.h"
#include "run/Run.h"
#include "run/SizeChoice.h"

namespace neuralmesh
{
/// Makes a mesh with as many vertices as the points support, or with as few as meet a tolerance.
/// The number of vertices of the parameters does not count. Small meshes are made and measured
/// first, and the prediction is checked at the end. The result has a `size`, unless `progress`
/// ended the run. whyNoSize() and whyNoSizeFor() must be empty.
Reconstruction reconstructSized(
  const RunRequest& request, const SizeGoal& goal, const Progress& progress);
}
