// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/Finish.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// With fewer points a vertex, creases come out rounder than they would on a coarser mesh.
inline constexpr std::size_t PointsThatTellCreases = 10;

/// Whether creases are a good part of the surface: whether their edges are more than go twice across it.
bool hasCreases(const Mesh& mesh);

/// Refines a mesh that is finished, and has creases, to `count` vertices, and keeps the creases as they are: edges
/// are halved, flat ones are flipped to be more regular, and vertices that are not at a crease move to so many
/// samples a vertex once more. `report` is that of the mesh, and follows. For clean clouds. Returns false if it was
/// ended before; then the mesh is valid all the same.
bool refineBesideCreases(const PointCloud& cloud, Mesh& mesh, std::size_t count,
  double samplesPerVertex, FinishReport& report, const Executor& executor,
  const Progress& progress);
}
