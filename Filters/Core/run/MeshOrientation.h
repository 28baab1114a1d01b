// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "mesh/Orientation.h"

namespace neuralmesh
{
/// Turns each piece of a mesh to its outer side. The first of these that tells decides: the viewpoints,
/// the up direction and the normals that are given, the volume, the pieces near by; but pieces near by
/// before the volume of an open piece that is less than a tenth of the largest, or makes its side a
/// guess. Such a guess counts for nothing where a level ground of a fifth of the piece would look down.
/// Where nothing tells, pieces look up, along z, unless they are upright; then they stay as they are.
/// They agree with each other. No vertex may be erased.
OrientationReport orientMesh(Mesh& mesh, const PointCloud& cloud, const OrientationHints& hints,
  const Executor& executor = Executor::sequential());
}
