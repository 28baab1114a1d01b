// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Executor.h"
#include "Finish.h"
#include "GrowthWatch.h"
#include "LearningCurve.h"
#include "MeshQuality.h"
#include "Progress.h"
#include "StoppingRules.h"
#include "TriangleMesh.h"

#include <optional>
#include <vector>

namespace neuralmesh
{
/// What a run gives, in the coordinates of the input.
struct Reconstruction
{
  TriangleMesh mesh;
  Mesh surface; ///< the same mesh, in the coordinates of the cloud
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> activities;
  std::vector<double> featureStrengths; ///< empty unless they were asked for
  RunCounts counts;
  LearningCurve curve;
  StopReason stopReason = StopReason::None;
  /// Nothing if the mesh was not finished.
  std::optional<FinishReport> finish;
  /// Nothing if the run was cancelled.
  std::optional<MeshQuality> quality;
  // CPU seconds of the process
  double startSeconds = 0.;
  double learningSeconds = 0.;
  double finishSeconds = 0.;
};

/// A mesh that is finished learns no more vertices than there is something to learn for.
Parameters learnable(Parameters parameters, const PointCloud& cloud);
/// Vertices of the first surface: a part of all, but enough for a shape, if all are twice as many.
std::size_t firstVertices(std::uint64_t vertices);

/// CPU seconds that the process has used so far.
double cpuSeconds();

// Where the parts of a run begin and end, as fractions of its progress.
inline constexpr double StartOfLearning = 0.15;
inline constexpr double EndOfLearning = 0.65;

/// Grows a mesh over a cloud that has an extent: from `first`, or what the parameters have it start
/// from if there is none, until a stopping rule is met. Then finishes it, unless there is no time
/// left, or nothing was learnt; and orients it outwards. Snapshots of the growth go to `watch`.
Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first = {}, const GrowthWatch& watch = {},
  const Executor& executor = Executor::sequential());
}
