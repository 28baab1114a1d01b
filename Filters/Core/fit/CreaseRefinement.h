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
/// With fewer points per vertex, creases are rounder than on a coarser mesh.
inline constexpr std::size_t PointsThatTellCreases = 10;

/// The length of creases, in widths of the surface: roots of its area.
double creaseWidths(const Mesh& mesh, const Executor& executor = Executor::sequential());
/// Beyond this, creases are a large part of the surface.
inline constexpr double WidthsOfCreases = 2.;
/// Whether they are.
bool hasCreases(const Mesh& mesh, const Executor& executor = Executor::sequential());

/// Refines a finished mesh with creases to `count` vertices and keeps the creases as they are.
/// Halves edges, flips flat edges to make the mesh more regular, and fits the vertices beside
/// creases once more. For clean clouds. `report` is that of the mesh and is updated. Returns false
/// if `progress` ended it; the mesh is valid even then.
bool refineBesideCreases(const PointCloud& cloud, Mesh& mesh, std::size_t count,
  double samplesPerVertex, FinishReport& report, const Executor& executor,
  const Progress& progress);
}
