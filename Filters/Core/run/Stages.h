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
/// The mesh from which learning starts, and how its samples are drawn.
struct Beginning
{
  std::optional<Mesh> mesh;    ///< nothing: a tetrahedron
  std::optional<GapPlan> gaps; ///< in the end; nothing: they stay as they are
  std::vector<float> weights;  ///< to draw samples by; empty: those of the cloud
  bool isFromGrid = false;     ///< the mesh: holes narrower than its edges may be closed
};

/// Makes the first surface, if the parameters ask for one. If `progress` ends it, or the cloud has
/// too few points to show a shape, learning starts from a tetrahedron.
Beginning begin(const PointCloud& cloud, const Parameters& parameters, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// The same with a first surface that shows narrow holes and gaps, or nothing if there is none. The parameters must ask for
/// a first surface.
std::optional<Beginning> beginWithNarrowParts(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const Executor& executor = Executor::sequential());

/// A learner of the cloud that starts there. `cloud` and `executor` must outlive it.
std::unique_ptr<Learner> learnerFrom(Beginning beginning, const PointCloud& cloud,
  const Parameters& parameters, const Executor& executor = Executor::sequential());

/// Returns the stopping rule that is met, or None. Returns Cancelled if `progress` ends the run.
StopReason ruleMet(const Learner& learner, StoppingRules& rules, const Progress& progress);

/// Number of samples between two checks. A run then ends within milliseconds, and the checks cost
/// nothing. Larger batches are not divided.
inline constexpr std::uint64_t SamplesPerCheck = 4096;

/// Learns at least so many samples and at least one batch, but no more than the parameters allow.
/// Returns the rule that is met then. Call it again as long as the answer is None.
StopReason learn(Learner& learner, StoppingRules& rules, const Parameters& parameters,
  std::uint64_t samples, const Progress& progress, const std::function<void()>& afterBatch = {});

/// Finishes a learnt mesh for `vertexCount` vertices. A mesh with more vertices is finished,
/// simplified and finished again. It keeps more vertices if its handles and pieces need them.
/// Returns nothing if `progress` ended it.
std::optional<FinishReport> finish(LearntMesh& learnt, const PointCloud& cloud,
  const Parameters& parameters, const std::optional<GapPlan>& gaps, std::size_t vertexCount,
  const Progress& progress, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {});

/// Finishes a learnt mesh so far that finishSimplified() can go on from it, or from copies.
std::optional<FinishReport> finishToSimplify(LearntMesh& learnt, const PointCloud& cloud,
  const Parameters& parameters, const std::optional<GapPlan>& gaps, const Progress& progress,
  const Executor& executor = Executor::sequential(), const OrientationHints& hints = {});

/// Simplifies a finished mesh to `vertexCount` vertices, or as few as its handles and pieces allow,
/// and finishes it again; `before` is the report of the first finish. Returns nothing if `progress`
/// ended it.
std::optional<FinishReport> finishSimplified(LearntMesh& learnt, const FinishReport& before,
  const PointCloud& cloud, const Parameters& parameters, std::size_t vertexCount,
  const Progress& progress, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {});

/// Finishes a mesh once more with another number of vertices; `before` is the report of the first
/// finish. The mesh is simplified, or its long edges are halved. Fewer rounds fit it, as it is
/// close to its points already. Returns nothing if `progress` ended it.
std::optional<FinishReport> finishAgain(LearntMesh& learnt, const FinishReport& before,
  const PointCloud& cloud, const Parameters& parameters, std::size_t vertexCount,
  const Progress& progress, const Executor& executor = Executor::sequential(),
  const OrientationHints& hints = {});

/// Refines a finished mesh to so many vertices and keeps its creases; see refineBesideCreases().
/// Updates `report`. Returns false if `progress` ended it.
bool refineFinished(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  std::size_t vertexCount, FinishReport& report, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// The part of finish() in the progress of finish() and tellUncertainty().
inline constexpr double PartBeforeUncertainty = 0.7;

/// Gives each vertex of a finished mesh the distance by which it may be off; see Uncertainty.h.
/// `result` has the report of the finish. Without a round of the fit, vertices get no such value.
/// Returns false if `progress` ended it.
bool tellUncertainty(LearntMesh& learnt, const PointCloud& cloud, const Parameters& parameters,
  Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential(), const OrientationHints& hints = {});

/// Turns the mesh to its outer side, and adds to `result` all that a user gets. Measures the
/// quality by `all` points unless `all` is null or `progress` ends it.
void describe(LearntMesh learnt, const PointCloud& cloud, const PointCloud* all,
  const OrientationHints& hints, Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential());

/// Adds to `result` an explanation of the points of the cloud, of all or of some. `left` are the
/// points without clusters of outliers; it is null if there are no clusters. A piece with less than
/// the part `leastPiece` of the points is small. Returns false if `progress` ended it: then a part
/// of the explanation is missing.
bool explainPoints(const PointCloud& cloud, const PointCloud* left, double leastPiece,
  bool explainsAll, Reconstruction& result, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
