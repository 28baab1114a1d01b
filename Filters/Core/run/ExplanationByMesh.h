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
/// Explains the points of a cloud with an extent by any triangle mesh. The mesh is in the
/// coordinates of the input, and need not be a manifold; its triangles must refer to existing
/// points. All points of the cloud are asked. Triangles without an area are left out, and those
/// with a corner that is not finite. The result has the same bytes with any executor. Returns
/// nothing if `progress` ended it. Throws std::runtime_error, with a sentence, if no triangle has
/// an area.
std::optional<Explanation> explainByMesh(const PointCloud& cloud, const TriangleMesh& mesh,
  const ExplanationRules& rules, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
