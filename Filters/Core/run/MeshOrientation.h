// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "mesh/Orientation.h"

namespace neuralmesh
{
/// Turns each piece of a mesh to its outer side. The first evidence decides: the given viewpoints, the up direction,
/// the normals, the volume, how dense the points are and what hides what if none of these is given, nearby pieces, what
/// rises from a ground. A room overrules its volume. If an open piece has less than a tenth of the largest volume, or
/// its volume is only a guess, what follows the volume comes before it. Neither a guess by volume counts, nor a smaller
/// piece near by, if a level ground of a fifth of the piece would look down. Pieces without evidence look up, along z,
/// and agree with each other; upright ones stay as they are. No vertex may be erased.
OrientationReport orientMesh(Mesh& mesh, const PointCloud& cloud, const OrientationHints& hints,
  const Executor& executor = Executor::sequential());
}
