// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh where the scan has no data: pieces of triangles on which none of the
/// places of samples lies, and which
/// - are so large that many should, if samples lay there as densely as around the piece, and
/// - lie at a boundary, or reach farther away from all points than points are from each other and
///   from the mesh; else the mesh does not fit yet.
/// Where triangles are smaller than the distance between samples, everywhere or around those nearest
/// to them, those near to a point are no part of such pieces.
/// With `mustBeFar` those at a boundary have to reach away from the points, too.
/// `places` are those of samples evenly picked from the cloud, `medianDistance` is that of the
/// samples to the mesh.
std::vector<Triangle> findDataGaps(const PointCloud& cloud, const Mesh& mesh,
  std::span<const PlaceOnMesh> places, float medianDistance, bool mustBeFar = false,
  const Executor& executor = Executor::sequential());

/// How gaps are to be opened and closed.
struct GapPlan
{
  double bridgeWidth = 0.; ///< see openDataGaps()
  bool mayOpen = true;     ///< not where the mesh began with openings where there is no data
  double leastPiece = 0.0005;
  bool mustBeFar = false; ///< at boundaries, too, see findDataGaps()
};

struct OpenedGaps
{
  std::size_t triangles = 0; ///< that were gaps
  std::size_t joined = 0;    ///< pairs of boundaries
  std::size_t filled = 0;    ///< boundaries

  bool any() const { return triangles + joined + filled > 0; }
};

/// Takes the gaps away, and small pieces that are left over: those that hold no more than five times the part
/// `leastPiece` of the samples, or do not lie on theirs. Boundaries that face each other, on average closer
/// than `bridgeWidth`, are joined: they are both sides of a web that lay across a handle. Slits narrower
/// than that which are close to points all along are closed: webs lay in creases there. Some vertices may
/// be erased.
OpenedGaps openDataGaps(const PointCloud& cloud, Mesh& mesh, std::span<const PlaceOnMesh> places,
  float medianDistance, const GapPlan& plan, const Executor& executor = Executor::sequential());
}
