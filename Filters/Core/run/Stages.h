// SPDX-License-Identifier: BSD-3-Clause
// The four stages of a run: begin, learn, finish, describe. Runs differ in what they do between them.
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "fit/Finish.h"
#include "learn/Learner.h"
#include "learn/StoppingRules.h"
#include "run/Reconstruction.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// What learning starts from.
struct Beginning
{
  std::optional<Mesh> mesh;    ///< nothing: a tetrahedron
  std::optional<GapPlan> gaps; ///< in the end; nothing: they stay as they are
  std::vector<float> weights;  ///< to draw samples by; empty: those of the cloud
};

/// Makes the first surface, if the parameters have learning start from one. If it is ended before, or
/// the cloud has too few points to tell a shape, learning starts from a tetrahedron.
Beginning begin(const PointCloud& cloud, const Parameters& parameters, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// A learner of the cloud that starts there. `cloud` and `executor` must outlive it.
std::unique_ptr<Learner> learnerFrom(Beginning beginning, const PointCloud& cloud,
  const Parameters& parameters, const Executor& executor = Executor::sequential());

/// The stopping rule that is met, or None; Cancelled if `progress` ends the run.
StopReason ruleMet(const Learner& learner, StoppingRules& rules, const Progress& progress);

/// Often enough to end within milliseconds, rarely enough to cost nothing; large batches are not
/// cut for it.
inline constexpr std::uint64_t SamplesPerCheck = 4096;

/// Learns so many samples at least, and a whole batch, but no more than all that the parameters allow.
/// Returns the rule that is met then. To be called again as long as that is None.
StopReason learn(Learner& learner, StoppingRules& rules, const Parameters& parameters,
  std::uint64_t samples, const Progress& progress, const std::function<void()>& afterBatch = {});

/// Finishes what was learnt, for `vertexCount` vertices: if it has more, it is simplified once it is
/// finished, and finished again. Handles and pieces may need more vertices than those. Returns nothing if it
/// was ended before.
std::optional<FinishReport> finish(LearntMesh& learnt, const PointCloud& cloud,
  const Parameters& parameters, const std::optional<GapPlan>& gaps, std::size_t vertexCount,
  const Progress& progress, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {});

/// Finishes once more what is finished, as `before` tells, with another number of vertices: it is simplified, or long
/// edges are halved, and fitted in fewer rounds, for it lies close already. Returns nothing if it was ended before.
std::optional<FinishReport> finishAgain(LearntMesh& learnt, const FinishReport& before,
  const PointCloud& cloud, const Parameters& parameters, std::size_t vertexCount,
  const Progress& progress, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {});

/// Refines what is finished to so many vertices, beside its creases; `report` follows. Returns false if it was
/// ended before.
bool refineFinished(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  std::size_t vertexCount, FinishReport& report, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// Of the progress of finish() and tellUncertainty().
inline constexpr double PartBeforeUncertainty = 0.7;

/// Tells each vertex of what is finished, as `result` has it, how far it may be off; see Uncertainty.h. Nothing is told
/// if no round of the fit is left. Returns false if it was ended before.
bool tellUncertainty(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential(), const OrientationHints& hints = {});

/// Turns the mesh to its outer side, and adds to `result` all that a user gets of it. Its quality is
/// measured by `all` points, if there are any, unless it is ended before.
void describe(LearntMesh learnt, const PointCloud& cloud, const PointCloud* all,
  const OrientationHints& hints, Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// Adds to what is described what becomes of the points of the cloud, of all or of some; `left` are those
/// without clusters of outliers, if it has some. Fewer points than the part `leastPiece` are a small piece. Returns false
/// if it was ended before: then some of it is missing.
bool explainPoints(const PointCloud& cloud, const PointCloud* left, double leastPiece,
  bool explainsAll, Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
