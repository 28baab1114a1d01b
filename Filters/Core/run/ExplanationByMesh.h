// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/TriangleMesh.h"
#include "run/Explanation.h"

#include <optional>

namespace neuralmesh
{
/// What any triangle mesh leaves of a cloud that has an extent, whatever made the mesh. It is in the
/// coordinates of the input and need be no manifold; its triangles must refer to points that are there. All
/// points of the cloud are asked. Triangles without an area, and those with a corner that is not finite, are
/// left out. The same bytes, whatever the executor. Returns nothing if `progress` ended it. Throws
/// std::runtime_error, with a sentence, if no triangle has an area.
std::optional<Explanation> explainByMesh(const PointCloud& cloud, const TriangleMesh& mesh,
  const ExplanationRules& rules, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
