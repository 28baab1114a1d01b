// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "run/FacePlanes.h"

#include <array>
#include <vector>

namespace neuralmesh
{
/// An inner edge of a mesh at which the planes of its two triangles differ.
struct CreaseEdge
{
  std::array<VertexIndex, 2> ends{};
  double angle =
    0.; ///< between both sides of the surface, by the points, where they meet; in degrees
  bool isConfirmed = false;
  /// Of the two sides, at the edge; unknown where there are too few points.
  std::array<FacePlanes::Plane, 2> sides;
};

/// The edges whose planes differ by more than half of `leastAngle`, in degrees. Such an edge is confirmed if
/// the points say so: on each side a surface of second degree is fitted to the points within a few edges,
/// which goes up to where both sides meet. There its slope has a standard error, by the residuals and the
/// number of points. The angle between both slopes must be larger than `leastAngle` by three standard errors, both
/// surfaces must fit within the noise, and one surface of third degree over both sides must fit clearly worse.
/// So neither noise nor a smooth bend makes a crease: what bends smoothly has about the same slope from both
/// sides. If `progress` ends it, the edges that were not looked at are not confirmed.
std::vector<CreaseEdge> findCreaseEdges(const FacePlanes& planes, const CloudPlaces& places,
  double leastAngle, const Progress& progress, const Executor& executor = Executor::sequential());
}
