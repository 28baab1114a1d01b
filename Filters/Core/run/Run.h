// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/InterruptibleExecutor.h"
#include "base/Progress.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "learn/GrowthWatch.h"
#include "learn/Learner.h"
#include "learn/Parameters.h"
#include "learn/StoppingRules.h"
#include "run/Checkpoint.h"
#include "run/Reconstruction.h"
#include "run/Stages.h"

#include <cstdint>
#include <functional>
#include <optional>

namespace neuralmesh
{
/// What is asked of a run. All must outlive it.
struct RunRequest
{
  const PointCloud& cloud;
  const Parameters& parameters;
  const std::optional<Mesh>& first;
  const Executor& executor;
  const OrientationHints& hints;
  bool explainsAll = false;
};

/// The same with other parameters, which must outlive it.
RunRequest requestWith(const RunRequest& request, const Parameters& parameters);

/// A mesh that has learnt all, and what its run knows so far.
struct LearntRun
{
  Reconstruction result; ///< counts, curve and stop reason
  LearntMesh learnt;
  StoppingRules rules;
  std::uint64_t vertices; ///< that it was to learn
  std::optional<GapPlan> gaps;
  bool isLearnt; ///< else it is not finished
  /// Of a run that went on from a checkpoint and has all vertices: the time limit would end each such run anew.
  bool mayTakeLonger = false;
};

/// A part of the progress of a run.
struct ProgressPart
{
  double begin = 0.;
  double end = 1.;
};

/// The parts of a run: one start, from which one mesh or several learn and are finished. A caller who has
/// ended one part is asked no more.
class Run
{
public:
  Run(const RunRequest& request, const Progress& progress);

  /// Makes the first surface for a mesh of so many vertices, unless there is a first mesh.
  Beginning begin(std::uint64_t vertices, ProgressPart part);
  /// The same with a first surface that shows narrow holes and gaps. Nothing if there is none.
  std::optional<Beginning> beginWithNarrowParts(std::uint64_t vertices, ProgressPart part);

  /// Learns so many vertices, or as many as the cloud has something to learn for.
  LearntRun learn(std::uint64_t vertices, Beginning beginning, ProgressPart part,
    Checkpoint& checkpoint, const GrowthWatch& watch = {});

  /// Finishes what is learnt, simplifies or refines it to as many vertices as are asked for, and
  /// describes it. `made` gets it before that, if there is one.
  Reconstruction finish(LearntRun run, std::uint64_t asked, ProgressPart part,
    const std::function<void(const LearntRun&)>& made = {});

  // The parts of finish(), for who measures meshes before one of them is described.

  /// Fits what is learnt, and simplifies or refines it to as many vertices as are asked for. Returns whether the run is
  /// complete so far: nothing was ended before.
  bool make(LearntRun& run, std::uint64_t asked, ProgressPart part);
  /// Makes of a mesh that is made and fitted one of a few more or of fewer vertices, and fits that. Returns likewise.
  bool makeAgain(LearntRun& run, std::uint64_t asked, ProgressPart part);
  /// Fits what is learnt so far that makeSimplified() can go on from copies of it. Returns likewise.
  bool makeToSimplify(LearntRun& run, ProgressPart part);
  /// Simplifies such a mesh, or one that is made, to `asked` vertices, and fits that. Returns likewise.
  bool makeSimplified(LearntRun& run, std::uint64_t asked, ProgressPart part);
  /// Tells error bars, if they are wanted, and describes what is made, which takes all of this part then.
  Reconstruction describe(LearntRun run, std::uint64_t asked, ProgressPart part);

private:
  const PointCloud& cloud() const { return cleaned_ ? *cleaned_ : request_.cloud; }
  void clean(const Parameters& parameters, double at);
  /// Leaves no report of the finish if it was ended before.
  void fit(LearntRun& run, std::uint64_t asked, const Progress& progress);
  /// Makes another mesh of one that is made, by finishAgain() or finishSimplified().
  template <typename Remake>
  bool remake(LearntRun& run, std::uint64_t asked, ProgressPart part, const Remake& remakeMesh);
  /// Reports of whether all is made in time.
  Progress inTime(const LearntRun& run, const Progress& progress) const;
  StopReason whyEnded() const;

  RunRequest request_;
  Progress progress_;
  bool isCancelled_ = false;
  double fraction_ = 0.; ///< last told
  /// For what leaves no mesh half changed.
  InterruptibleExecutor interruptible_;
  std::optional<PointCloud> cleaned_; ///< nothing: there are no clusters of outliers
};

/// So many vertices are learnt first. A mesh of few would lose what is narrower than its edges while it learns, so it
/// is simplified from more.
std::uint64_t verticesToLearn(const RunRequest& request);
/// Of a run and another one that came after it: the second if it is better than the first, or was cancelled.
Reconstruction betterOf(Reconstruction first, Reconstruction other,
  const std::function<bool(const Reconstruction& other, const Reconstruction& first)>& isBetter);
/// `result`, which has learnt so many; or a run of its own that learns fewer or as many as are asked for, where that
/// may be better and is.
Reconstruction betterRun(
  Reconstruction result, const RunRequest& request, const Progress& progress);
/// Whether the mesh misses points that are no outliers, or crosses or folds itself, as it does where parts are thinner
/// than its edges are long. Not where a draft is asked for.
bool mayHaveLostThinParts(const Reconstruction& result, const RunRequest& request);
/// Of a mesh that is simplified from a finer one, and one that is not: whether the first has as many vertices, and
/// holds more of the cloud. A fold, which is told, is less than a part that is missing.
bool holdsMore(const Reconstruction& finer, const Reconstruction& other);
/// `result`; or a mesh that is simplified from a finer one, of 20,000 vertices or twice as many, if the first may have
/// lost thin parts, and the second holds more. `made` is what `result` was made of, before it was described; it becomes
/// that of the second.
Reconstruction runWithThinParts(Reconstruction result, const RunRequest& request,
  const Progress& progress, LearntRun* made = nullptr);
/// `result`; or a mesh whose first surface has more handles, if `result` may have filled holes, and the other one holds
/// more.
Reconstruction runWithNarrowHoles(
  Reconstruction result, const RunRequest& request, const Progress& progress);
/// `result`, or what betterRun(), runWithThinParts() and runWithNarrowHoles() make of it, one after the other.
Reconstruction withFurtherRuns(
  Reconstruction result, const RunRequest& request, const Progress& progress);
}
