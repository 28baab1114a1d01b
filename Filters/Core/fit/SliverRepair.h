// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "fit/FitGuard.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// Takes slivers away, see removeSlivers(), but for those without which triangles would intersect or fold, and
/// all of them stay where points would be lost. As many vertices come in again where edges are long. No vertex
/// may be erased, and none is in the end.
void repairSlivers(Mesh& mesh, FitGuard& guard, const Executor& executor = Executor::sequential());
}
