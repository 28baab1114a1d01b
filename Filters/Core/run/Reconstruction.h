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
#include "run/NoiseWebs.h"
#include "run/SizeChoice.h"
#include "run/SpannedGaps.h"

#include <optional>
#include <string>
#include <vector>

namespace neuralmesh
{
/// The result of a run, in the coordinates of the input.
struct Reconstruction
{
  /// Whether the run was neither cancelled nor ended by the time limit.
  bool isComplete() const
  {
    return stopReason != StopReason::Cancelled && stopReason != StopReason::TimeLimit;
  }

  TriangleMesh mesh;
  Mesh surface; ///< the same mesh, in the coordinates of the cloud
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> activities;
  VertexSupport support;                ///< points at the vertices; empty if the run was cancelled
  std::vector<double> featureStrengths; ///< empty unless they were asked for
  std::vector<float> uncertainties; ///< empty unless asked for, and if no round of the fit is left
  /// Part of the vertices around which views lie farther apart than error bars explain, and the
  /// place where they lie farthest apart
  double disagreeingShare = 0.;
  Vector4 disagreement;
  RunCounts counts;
  LearningCurve curve;
  StopReason stopReason = StopReason::None;
  std::uint64_t resumedIterations = 0; ///< iterations of the checkpoint that the run continued
  /// Nothing if the mesh was not finished.
  std::optional<FinishReport> finish;
  /// Nothing if the run was cancelled.
  std::optional<MeshQuality> quality;
  OrientationReport orientation;
  /// An explanation of some points, or of all on demand. Nothing if the run was cancelled.
  std::optional<Explanation> explanation;
  std::vector<SpannedGap> gaps;      ///< that the mesh spans; empty if the run was cancelled
  std::vector<NoiseWeb> noiseWebs;   ///< empty if the cloud is clean, or the run was cancelled
  std::vector<std::string> warnings; ///< see Warnings.h
  std::optional<SizeChoice> size;    ///< if the program chose the number of vertices
  PhaseTimes times;                  ///< of start, learning and finish
  bool isFromGrid = false;           ///< see Beginning
};

/// Limits the number of vertices of a fitted mesh to the number that the points support.
Parameters learnable(Parameters parameters, const PointCloud& cloud);
/// The number of vertices of the first surface: an eighth of all, but enough for a shape, up to
/// half of all. In a draft, more are enough for a shape.
std::size_t firstVertices(std::uint64_t vertices, Fidelity fidelity);
/// The default number of points of a file: fifty per vertex, as many as samples are drawn, but at
/// least a million, which show the shape.
std::uint64_t usualPoints(std::uint64_t vertices);

// The parts of a run, as fractions of its progress. A draft learns for longer, and is fitted for less long.
inline constexpr double StartOfLearning = 0.1;
inline constexpr double EndOfLearning = 0.4;
inline constexpr double StartOfDescription = 0.92;

/// How much of the progress the first run of reconstruct() has, which is the only one of most clouds. Whether others
/// follow is known only when it is over: if none does, this is the last that is told.
double partOfFirstRun(const Parameters& parameters, bool hasFirstMesh = false);

/// Grows a mesh over a cloud with an extent until a stopping rule is met. It starts from `first`
/// or, without it, from the start of the parameters. Then finishes the mesh, unless no time is
/// left, or there is neither a first mesh nor a learnt sample. Turns it to its outer side by
/// `hints`. Snapshots of the growth go to `watch`. The run continues from the checkpoint that
/// `plan` names, if there is one, and leaves a checkpoint even at the end, as the caller may still
/// fail to save the result. With `explainsAll`, all points are explained, else some. Throws like
/// Checkpoint.
Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first = {}, const GrowthWatch& watch = {},
  const CheckpointPlan& plan = {}, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {}, bool explainsAll = false);
}
