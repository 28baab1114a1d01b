// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "run/Reconstruction.h"

#include <string>
#include <vector>

namespace neuralmesh
{
/// What a user must know of a mesh before using it: one sentence each, with what can be done. Empty
/// where the mesh is what the cloud is; of a run that was cancelled, only what is known of the sides.
/// - more than 3 % of the points are farther from the mesh than points are from each other, and no
///   outliers; or a piece or limb of them is missing: where, and how many;
/// - the mesh cuts off more than 0.035 % of the points at narrow rims: they are farther from it than from each other;
/// - the mesh ends before six points, or more, at a sparse end of the cloud;
/// - around more than half of the points others lie in all directions, so that they tell no surface;
/// - the mesh has an opening where there are points;
/// - more than 4 % of the area has hardly any points, unless gaps were to be closed;
/// - the mesh spans a gap of the cloud by more than 0.05 % of the area, unless gaps were to be closed;
/// - triangles intersect others, or are folded;
/// - more than 0.2 % of the triangles are nearly lines;
/// - the mesh has stopped growing below the size that was asked for;
/// - the mesh is finer than its data: it has more vertices than every second point;
/// - the fit was taken back: with it the mesh had a larger residual, lost points, or intersected;
/// - error bars were asked for, and there are none: the run ended before its fit, or took all of that back;
/// - views lie apart by more than error bars know around more than 2 % of the vertices, or the mesh lies between two
///   layers of points, so that they are too short;
/// - nothing tells the outer side of pieces with more than a thousandth of the area, unless they are one
///   piece of all: that agrees with itself, and can be turned as a whole;
/// - parts look to opposite sides where they face each other across openings;
/// - viewpoints or normals were given, and tell nothing.
std::vector<std::string> warningsOf(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters = {});

/// The same of a surface that was remeshed: triangles that intersect, folds and slivers, and another number of vertices
/// than was asked for.
std::vector<std::string> warningsOfSurface(
  const Reconstruction& result, const Parameters& parameters);

/// The same of a mesh to start from: that it has more vertices than are asked for, and what becomes of it then.
/// Empty if it has not.
std::string warningOfFirst(const Mesh& first, const Parameters& parameters);
}
