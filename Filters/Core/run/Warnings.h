// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "run/Reconstruction.h"

#include <string>
#include <vector>

namespace neuralmesh
{
/// What a user must know of a mesh before using it: what is wrong, where, why, and what to do. Each warning
/// ends with its tag; Documentation/Guide/Failures.md has a section for each tag. The list is empty for a
/// mesh that fits its cloud. After a cancelled run it has only what is known of piles and of the sides. Limits:
/// - points coincide: any pile;
/// - points are unexplained: more than 3 % of them;
/// - coarse: the mesh cuts off more than 0.035 % of the points at narrow rims, or five within two edges of one of them;
/// - open where points are: the mesh ends before six of the asked points where points are sparse;
/// - no surface: more than half of the points have others around them in all directions;
/// - surface without points: more than 4 % of the area, or a piece, unless gaps were to be closed;
/// - a gap is spanned: by more than 0.02 % of the area, unless gaps were to be closed;
/// - between layers: more than 10 % of the vertices;
/// - finer than the noise: two vertices on noise webs;
/// - slivers: more than 0.2 % of the triangles;
/// - finer than data: more vertices than half of the different points;
/// - error bars too short: views lie apart around more than 2 % of the vertices;
/// - inside out: more than 0.5 % of the area;
/// - the side is unknown: for more than 0.1 % of the area, unless it is one piece. Such a piece agrees with
///   itself and can be turned as a whole.
std::vector<std::string> warningsOf(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters = {});

/// The same for a remeshed surface: triangles that intersect, folds, slivers, another number of vertices.
std::vector<std::string> warningsOfSurface(
  const Reconstruction& result, const Parameters& parameters);

/// The same for a first mesh with more vertices than are asked for. Empty if it has not.
std::string warningOfFirst(const Mesh& first, const Parameters& parameters);
}
