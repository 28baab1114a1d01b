// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/Pieces.h"

#include <vector>

namespace neuralmesh
{
/// Of some pieces of a mesh, those that are not needed: without them all, the mesh would miss fewer points beside each
/// than `part` of the cloud, or so few that they lie together by chance. A point is missed if it is farther from the
/// mesh than three times its distance to its neighbours, and eight times farther than half of the points are.
std::vector<Piece> withoutNeeded(std::vector<Piece> pieces, const Mesh& mesh,
  const PointCloud& cloud, double part, const Executor& executor = Executor::sequential());
}
