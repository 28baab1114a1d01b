// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/HeldOutPoints.h"
#include "mesh/Mesh.h"
#include "mesh/NarrowHandles.h"
#include "mesh/NarrowNecks.h"
#include "mesh/SurfaceReport.h"

#include <optional>

namespace neuralmesh
{
/// The figures of a mesh: its distance to the cloud, and properties of its surface.
struct MeshQuality
{
  /// The root mean square distance of the held-out points to the mesh, without outliers, in units
  /// of the input.
  double residual = 0.;
  double outlierShare = 0.; ///< part of these points
  SurfaceReport surface;
  /// The part of the area that looks inwards although most of its piece looks outwards, or the
  /// other way round.
  double turnedShare = 0.;
  NarrowHandles narrowHandles;
  NarrowNecks narrowNecks;
};

/// `triangles` are those of the mesh. Of very many points only some are measured; to the nearest triangle, of a surface,
/// none is an outlier. Nothing if `progress` ends it.
std::optional<MeshQuality> measureQuality(
  const PointCloud& cloud, const Mesh& mesh, const TriangleMesh& triangles,
  const Executor& executor = Executor::sequential(), DistanceTo to = DistanceTo::SurfaceAgain,
  const Progress& progress = [](double) { return true; });
}
