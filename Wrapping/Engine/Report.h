// SPDX-License-Identifier: BSD-3-Clause
// What a run gives, by the names of the arrays that vtkNeuralMesh gives.
#pragma once

#include "cloud/PointCloud.h"
#include "learn/GrowthWatch.h"
#include "run/FeatureLines.h"
#include "run/Reconstruction.h"
#include "run/Tuning.h"

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

namespace neuralmesh::binding
{
/// A dict of `points`, `triangles` and the dict `point_data`.
nanobind::dict meshOf(const Reconstruction& result, bool isDouble);
nanobind::dict meshOf(const GrowthSnapshot& snapshot, bool isDouble);
nanobind::dict meshOf(const TriangleMesh& mesh, bool isDouble);

/// Adds to field data: a number, a text or a list of texts for each name.
void addSides(const OrientationReport& report, nanobind::dict& fields);
void addQuality(const Reconstruction& result, double unit, nanobind::dict& fields);
void addCounts(const Explanation& explanation, nanobind::dict& fields);
void addTuning(const Tuning& tuning, nanobind::dict& fields);
void addSize(const SizeChoice& choice, nanobind::dict& fields);
/// What is chosen, and why, a text each.
std::vector<std::string> textsOf(const Tuning& tuning);

/// Columns of the learning curve.
nanobind::dict curveOf(const LearningCurve& curve);

/// Of as many points as the input has, a dict of the arrays `Distance` and `Reason`, and the fields.
nanobind::dict explainedOf(
  const Explanation& explanation, const PointCloud& cloud, std::size_t pointCount);

/// A dict of `points`, `corners` (points), `line_points` of all lines one behind the other, `line_ends`, the
/// dicts `point_data` and `cell_data` (of corners, and behind them of lines), and `creases` of the mesh.
nanobind::dict linesOf(const FeatureLines& lines, bool isDouble);
}
