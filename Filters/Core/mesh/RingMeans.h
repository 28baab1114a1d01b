// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <vector>

namespace neuralmesh
{
/// Each value of a vertex becomes the mean of it and those of its neighbours, as often as there are to be rings. No
/// vertex may be erased.
void averageOverRings(
  const Mesh& mesh, std::vector<float>& values, int rings, const Executor& executor);
}
