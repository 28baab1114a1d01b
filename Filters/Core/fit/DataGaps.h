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
/// What is known of a mesh in which gaps are looked for.
struct GapRules
{
  bool mustBeFar = false; ///< pieces at a boundary must reach away from the points, too
  /// The mesh fits as well as it ever will. Then tubes on which many samples are missing are looked for, too. They may be
  /// less far from the points, and samples that are farther from the mesh than from each other do not count there.
  bool isFitted = true;
};

/// Returns the triangles of a mesh where the scan has no data. They form pieces on which no sample
/// has its place, and which
/// - are so large that many samples would lie there at the density around the piece, and
/// - lie at a boundary, or reach farther away from all points than points are from each other and
///   from the mesh. Otherwise the mesh does not fit yet.
/// If triangles are smaller than the distance between samples, those near a point belong to no
/// piece. `places` are the places of samples that were picked evenly from the cloud; `medianDistance` is the median of
/// their distances to the mesh.
std::vector<Triangle> findDataGaps(const PointCloud& cloud, const Mesh& mesh,
  std::span<const PlaceOnMesh> places, float medianDistance, GapRules rules = {},
  const Executor& executor = Executor::sequential());

/// How to open and close gaps.
struct GapPlan
{
  double bridgeWidth = 0.; ///< see openDataGaps()
  bool mayOpen = true;     ///< false if the first surface is open already where there is no data
  double leastPiece = 0.0005;
  GapRules rules = {};
};

struct OpenedGaps
{
  std::size_t triangles = 0; ///< number of removed triangles, without those of tubes
  std::size_t tubes = 0;     ///< number of tubes that were cut, see cutTubes()
  std::size_t joined = 0;    ///< number of pairs of boundaries that were joined
  std::size_t filled = 0;    ///< number of boundaries that were filled

  bool any() const { return triangles + tubes + joined + filled > 0; }
};

/// Cuts tubes, see cutTubes(). Removes the triangles of gaps, and small pieces that are left over: those with no more than five
/// times the part `leastPiece` of the samples, and those whose samples do not lie on them. Joins
/// boundaries that face each other closer than `bridgeWidth` on average: they are the two sides of
/// a web across a handle. Closes slits that are narrower than that and close to points all along:
/// webs in creases leave them. Some vertices may be erased.
OpenedGaps openDataGaps(const PointCloud& cloud, Mesh& mesh, std::span<const PlaceOnMesh> places,
  float medianDistance, const GapPlan& plan, const Executor& executor = Executor::sequential());
}
