// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/Orientation.h"
#include "mesh/Pieces.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The sides of pieces by what hides what. A scan from few places ends in shadows: where one part hides another, the
/// hidden one has a gap. So a place from which the surface goes on only behind something nearer, along much of its
/// boundaries, is one from where it was scanned, and the surface faces it. Such a place is searched for in and around
/// the bounding box, and at the origin, where a camera often is. The side is a guess: it is told only if no place that
/// sees the other sides of the surface explains half as much.
///
/// Nothing is told of pieces with a certain side, nor where these have most of the area, nor where boundaries
/// are short: the outline of a scan is no shadow. No vertex may be erased.
std::vector<Side> sidesByShadows(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> known, const PointCloud& cloud,
  const Executor& executor = Executor::sequential());

/// What shadows tell against the volume.
struct FromWithin
{
  std::vector<Side> sides;
  bool isInDoubt = false; ///< whether they tell it of any piece
};

/// The sides of large pieces that look outwards by their volume, though shadows tell that each was scanned from within,
/// as a room with things in it: a place within its bounding box must explain five times as much as any that sees the
/// outer sides. If gaps that are seen along the surface are needed for that, the side is only in doubt. What looks away
/// from there is turned, too, if it lies in that box.
FromWithin sidesFromWithin(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> byVolume, const PointCloud& cloud,
  const Executor& executor = Executor::sequential());
}
