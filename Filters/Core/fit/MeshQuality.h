// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/HeldOutPoints.h"
#include "mesh/Mesh.h"
#include "mesh/NarrowHandles.h"
#include "mesh/SurfaceReport.h"

namespace neuralmesh
{
/// How well a mesh stands for its cloud, and what it is by itself.
struct MeshQuality
{
  /// Distance of the points that are held out of the fit to the mesh, without outliers: root of the
  /// mean square, in units of the input.
  double residual = 0.;
  double outlierShare = 0.; ///< of these points
  SurfaceReport surface;
  /// Of the area: what looks inwards though most of its piece looks outwards, or the other way round.
  double turnedShare = 0.;
  NarrowHandles narrowHandles;
};

/// `triangles` are those of the mesh. Of very many points only some are measured; to the nearest triangle, of a surface,
/// none is an outlier. Where `progress` ends it, the rest is as if nothing were found.
MeshQuality measureQuality(
  const PointCloud& cloud, const Mesh& mesh, const TriangleMesh& triangles,
  const Executor& executor = Executor::sequential(), DistanceTo to = DistanceTo::SurfaceAgain,
  const Progress& progress = [](double) { return true; });
}
