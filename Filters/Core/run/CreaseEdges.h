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
    0.; ///< between both sides of the surface where they meet, by the points; in degrees
  bool isConfirmed = false;
  /// The planes of the two sides at the edge; unknown if there are too few points.
  std::array<FacePlanes::Plane, 2> sides;
};

/// Returns the edges whose planes differ by more than half of `leastAngle`, in degrees, and
/// confirms some by the points. On each side, a quadratic surface is fitted to the points within a
/// few edges, up to the line where both sides meet. Its slope there has a standard error, which
/// follows from the residuals and the number of points. A confirmed edge meets three conditions.
/// The angle between both slopes exceeds `leastAngle` by three standard errors. Both surfaces fit
/// within the noise. One cubic surface over both sides fits clearly worse. So neither noise nor a
/// smooth bend makes a crease: a smooth bend has about the same slope from both sides. If
/// `progress` ends the search, edges that were not examined are not confirmed.
std::vector<CreaseEdge> findCreaseEdges(const FacePlanes& planes, const CloudPlaces& places,
  double leastAngle, const Progress& progress, const Executor& executor = Executor::sequential());
}
