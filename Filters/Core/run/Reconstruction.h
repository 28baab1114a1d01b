// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PhaseTimes.h"
#include "base/Progress.h"
#include "cloud/OrientationHints.h"
#include "fit/Finish.h"
#include "fit/MeshQuality.h"
#include "learn/GrowthWatch.h"
#include "learn/LearningCurve.h"
#include "learn/StoppingRules.h"
#include "mesh/Orientation.h"
#include "mesh/TriangleMesh.h"
#include "run/Checkpoint.h"
#include "run/Explanation.h"
#include "run/SizeChoice.h"
#include "run/SpannedGaps.h"

#include <optional>
#include <string>
#include <vector>

namespace neuralmesh
{
/// What a run gives, in the coordinates of the input.
struct Reconstruction
{
  /// Whether the run came to its end: it was not cancelled, and there was time for all of it.
  bool isComplete() const
  {
    return stopReason != StopReason::Cancelled && stopReason != StopReason::TimeLimit;
  }

  TriangleMesh mesh;
  Mesh surface; ///< the same mesh, in the coordinates of the cloud
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> activities;
  VertexSupport support; ///< what the vertices rest on; empty if the run was cancelled
  std::vector<double> featureStrengths; ///< empty unless they were asked for
  std::vector<float> uncertainties;     ///< likewise, or if no round of the fit is left
  /// Part of the vertices around which views lie apart by more than error bars know, and where most.
  double disagreeingShare = 0.;
  Vector4 disagreement;
  RunCounts counts;
  LearningCurve curve;
  StopReason stopReason = StopReason::None;
  std::uint64_t resumedIterations = 0; ///< those of the checkpoint from which the run went on
  /// Nothing if the mesh was not finished.
  std::optional<FinishReport> finish;
  /// Nothing if the run was cancelled.
  std::optional<MeshQuality> quality;
  OrientationReport orientation;
  /// Of some points, or of all if that was asked for. Nothing if the run was cancelled.
  std::optional<Explanation> explanation;
  std::vector<SpannedGap> gaps;      ///< that the mesh spans; empty if the run was cancelled
  std::vector<std::string> warnings; ///< see Warnings.h
  std::optional<SizeChoice> size;    ///< if nobody said how many vertices there are to be
  PhaseTimes times;                  ///< of start, learning and finish
};

/// A mesh that is finished learns no more vertices than there is something to learn for.
Parameters learnable(Parameters parameters, const PointCloud& cloud);
/// Vertices of the first surface: a part of all, but enough for a shape, if all are twice as many.
std::size_t firstVertices(std::uint64_t vertices);
/// How many points of a file are used if nobody says: fifty a vertex, as many as samples are drawn, but a
/// million at least, which tell the shape.
std::uint64_t usualPoints(std::uint64_t vertices);

// Where the parts of a run begin and end, as fractions of its progress.
inline constexpr double StartOfLearning = 0.15;
inline constexpr double EndOfLearning = 0.65;

/// Grows a mesh over a cloud that has an extent: from `first`, or what the parameters have it start
/// from if there is none, until a stopping rule is met. Then finishes it, unless there is no time
/// left, or there is neither a first mesh nor anything learnt; and turns it to its outer side, by
/// `hints` if they tell. Snapshots of the growth go to `watch`. The run goes on from the checkpoint
/// that `plan` names, if there is one, and leaves one there: in the end, too, for what becomes of the
/// result is not known here. With `explainsAll` all points are explained, else some. Throws as Checkpoint
/// does.
Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first = {}, const GrowthWatch& watch = {},
  const CheckpointPlan& plan = {}, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {}, bool explainsAll = false);
}
