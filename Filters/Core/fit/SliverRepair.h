// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "fit/FitGuard.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Removes slivers, see removeSlivers(), unless triangles would intersect or fold. All slivers stay
/// if points would be lost. Halves long edges to keep the number of vertices. No vertex may be
/// erased, before or after.
void repairSlivers(Mesh& mesh, FitGuard& guard, const Executor& executor = Executor::sequential());
}
