// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"

#include "fit/CreaseRefinement.h"
#include "mesh/QuadricSimplification.h"
#include "run/Stages.h"
#include "run/Warnings.h"
#include "start/OutlierClusters.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// With less the mesh would follow single points, not the surface.
constexpr std::size_t PointsPerVertex = 2;
constexpr std::size_t LeastLearnt = 100;
/// A mesh of fewer vertices would lose what is narrower than its edges while it learns. So that many are
/// learnt, if there are twenty points for each, and simplified.
constexpr std::uint64_t LeastLearntToFit = 1000;
constexpr std::uint64_t PointsToSimplify = 20;

/// Of residuals: a few points at creases make most of them, so they are told no better.
constexpr double TimesOfDraw = 1.2;
/// Of the progress of the finish.
constexpr double PartBeforeRefinement = 0.6;

/// Learns until a stopping rule is met; returns which.
StopReason learnAll(LearningState state, Checkpoint& checkpoint, const PointCloud& cloud,
  const Parameters& parameters, const GrowthWatch& watch, const Progress& progress)
{
  auto& [learner, rules, curve, reason] = state;
  GrowthRecorder recorder(watch, learner, cloud, parameters.numberOfVertices);
  if (reason == StopReason::None)
  {
    reason = ruleMet(learner, rules, progress);
  }
  for (;;)
  {
    checkpoint.saveIfDue(state);
    if (reason != StopReason::None || curve.isRowDue(learner))
    {
      curve.add(learner, cloud.unit(), rules.seconds());
    }
    if (reason != StopReason::None)
    {
      return reason;
    }
    reason = learn(
      learner, rules, parameters, SamplesPerCheck, progress, [&recorder] { recorder.takeIfDue(); });
  }
}

/// As reconstruct(), but learns so many vertices, and simplifies or refines the mesh if these are too many or too few.
Reconstruction learnAndFinish(std::uint64_t vertices, const PointCloud& input,
  const Parameters& requested, const Progress& report, const std::optional<Mesh>& first,
  const GrowthWatch& watch, const CheckpointPlan& plan, const Executor& executor,
  const OrientationHints& hints, bool explainsAll)
{
  Reconstruction result;
  // Once the caller has ended the run, it is asked no more.
  bool isCancelled = false;
  const Progress progress = [&](double fraction)
  { return !isCancelled && !(isCancelled = !report(fraction)); };
  Checkpoint checkpoint(plan, input, requested);

  result.times.enter(Phase::Start);
  Parameters toLearn = requested;
  toLearn.numberOfVertices = vertices;
  const Parameters parameters = learnable(toLearn, input);
  const bool startsFromSpace = !first && parameters.start == Start::OccupiedSpace;
  const double startOfLearning = startsFromSpace ? StartOfLearning : 0.;
  const double endOfLearning = parameters.fitRounds > 0 ? EndOfLearning : 1.;
  const std::optional<PointCloud> cleaned = startsFromSpace ? withoutClusters(input) : std::nullopt;
  const PointCloud& cloud = cleaned ? *cleaned : input;
  Beginning beginning = first
    ? Beginning{ first, {}, {} }
    : begin(cloud, parameters, partOf(progress, 0., startOfLearning), executor);
  const std::optional<GapPlan> gaps = beginning.gaps;

  result.times.enter(Phase::Learning);
  std::unique_ptr<Learner> learner = learnerFrom(std::move(beginning), cloud, parameters, executor);
  StoppingRules rules(cloud, parameters, learner->mesh().vertexCount());
  LearningState state{ *learner, rules, result.curve };
  result.resumedIterations = checkpoint.resume(state, !isCancelled);
  result.stopReason = learnAll(
    state, checkpoint, cloud, parameters, watch, partOf(progress, startOfLearning, endOfLearning));
  result.counts = learner->counts();
  learner->compact();
  LearntMesh learnt = learner->learntMesh();
  learner.reset();
  const bool isSimplified = !first && learnt.mesh.vertexCount() > requested.numberOfVertices;

  result.times.enter(Phase::Finish);
  const auto most = std::size_t(std::min(vertices, requested.numberOfVertices));
  // A first mesh may have all vertices already: then it is fitted as it is.
  if (parameters.fitRounds > 0 && result.isComplete() && (first || result.counts.iterations > 0))
  {
    const std::size_t there = learnt.mesh.vertexCount();
    const std::size_t finished = result.stopReason != StopReason::Vertices ? there
      : first                                                              ? std::max(there, most)
                                                                           : most;
    const auto refined = std::size_t(learnable(requested, input).numberOfVertices);
    const bool isRefined = vertices < requested.numberOfVertices && finished == most;
    const Progress rest = partOf(progress, endOfLearning, 1.);
    const Progress finishing = [&](double fraction)
    {
      const bool isTimeOver = parameters.timeLimit > 0. && rules.seconds() >= parameters.timeLimit;
      return rest(fraction) && !isTimeOver;
    };
    const bool isTold = parameters.computeUncertainty;
    const double endOfFit = isTold ? PartBeforeUncertainty : 1.;
    const double endOfFirst = isRefined ? PartBeforeRefinement * endOfFit : endOfFit;
    result.finish = finish(learnt, cloud, parameters, gaps, finished,
      partOf(finishing, 0., endOfFirst), executor, hints);
    if (result.finish && isRefined)
    {
      if (!refineFinished(learnt, cloud, parameters, refined, *result.finish,
            partOf(finishing, endOfFirst, endOfFit), executor))
      {
        result.finish.reset();
      }
      result.curve.endWith(learnt.mesh);
    }
    if (!result.finish ||
      (isTold &&
        !tellUncertainty(
          learnt, cloud, parameters, result, partOf(finishing, endOfFit, 1.), executor, hints)))
    {
      result.stopReason = isCancelled ? StopReason::Cancelled : StopReason::TimeLimit;
    }
  }
  if (isSimplified)
  {
    simplifyByQuadrics(learnt.mesh, most); // If there was no time to finish it.
    result.curve.endWith(learnt.mesh);
  }
  describe(std::move(learnt), cloud, result.stopReason == StopReason::Cancelled ? nullptr : &input,
    hints, result, executor);
  if (result.stopReason != StopReason::Cancelled)
  {
    explainPoints(
      input, cleaned ? &*cleaned : nullptr, requested.keepPieces, explainsAll, result, executor);
  }
  result.warnings = warningsOf(result, input, requested);
  result.times.leave();
  return result;
}

/// Not where rules end the run that are meant for the mesh as it learns.
bool mayLearnOtherwise(const Parameters& parameters)
{
  return parameters.fitRounds > 0 && !parameters.topologyLearning && parameters.timeLimit == 0. &&
    parameters.maximumIterations == 0 && parameters.targetSampleDistance == 0. &&
    parameters.targetCloudDistance == 0. && parameters.targetNormalChange == 0.;
}

/// Handles and pieces may need more vertices than there are to be, or so many that the rest is too coarse, and
/// where many stop growing, few may not.
bool isRight(const Reconstruction& simplified, std::uint64_t vertices)
{
  return simplified.stopReason == StopReason::Vertices &&
    simplified.surface.vertexCount() == vertices && simplified.finish &&
    simplified.finish->left.total() == 0;
}

/// Whether there are fewer points a vertex than tell creases, of which the mesh has some, and they may come out
/// sharper on a coarser one.
bool mayHaveRoundedCreases(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters)
{
  return result.stopReason == StopReason::Vertices && result.finish && result.finish->isClean &&
    parameters.fidelity != Fidelity::Draft && parameters.fitSmoothness == 0. &&
    !parameters.computeFeatureStrength &&
    result.surface.vertexCount() > cloud.differentCount() / PointsThatTellCreases &&
    hasCreases(result.surface);
}

/// Whether the first mesh has so many vertices, and a residual smaller than that of the second so many times.
bool isCloser(const Reconstruction& first, const Reconstruction& second, std::uint64_t vertices,
  double times = 1.)
{
  return first.surface.vertexCount() == vertices && first.quality && second.quality &&
    first.quality->residual < times * second.quality->residual;
}

/// Of a mesh that was refined beside its creases, and one that has learnt all of its vertices: whether the first is
/// to be taken. Few of the points that tell it lie at creases, so a draw goes to that; not where it has more slivers, or
/// more to be warned of: parts that are thin or small may be lost on a coarser mesh.
bool isBetterRefined(const Reconstruction& refined, const Reconstruction& learnt)
{
  if (!refined.finish || !refined.quality || !learnt.quality ||
    refined.finish->left.total() > learnt.finish->left.total() ||
    refined.warnings.size() > learnt.warnings.size())
  {
    return false;
  }
  const bool hasMoreSlivers = refined.quality->surface.slivers > learnt.quality->surface.slivers;
  return isCloser(
    refined, learnt, learnt.surface.vertexCount(), hasMoreSlivers ? 1. / TimesOfDraw : TimesOfDraw);
}
}

Parameters learnable(Parameters parameters, const PointCloud& cloud)
{
  if (parameters.fitRounds > 0)
  {
    parameters.numberOfVertices = std::min<std::uint64_t>(
      parameters.numberOfVertices, std::max(LeastLearnt, cloud.differentCount() / PointsPerVertex));
  }
  return parameters;
}

std::size_t firstVertices(std::uint64_t vertices)
{
  return std::size_t(std::max(vertices / 8, std::min<std::uint64_t>(vertices / 2, 1500)));
}

std::uint64_t usualPoints(std::uint64_t vertices)
{
  constexpr std::uint64_t PointsPerVertex = 50;
  constexpr std::uint64_t FewestPoints = 1000000;
  return std::max(FewestPoints, PointsPerVertex * vertices);
}

Reconstruction reconstruct(const PointCloud& input, const Parameters& requested,
  const Progress& report, const std::optional<Mesh>& first, const GrowthWatch& watch,
  const CheckpointPlan& plan, const Executor& executor, const OrientationHints& hints,
  bool explainsAll)
{
  const std::uint64_t asked = requested.numberOfVertices;
  const auto learn = [&](std::uint64_t least, const Progress& progress, const GrowthWatch& growth,
                       const CheckpointPlan& there)
  {
    return learnAndFinish(
      least, input, requested, progress, first, growth, there, executor, hints, explainsAll);
  };
  const std::uint64_t least =
    std::min<std::uint64_t>(LeastLearntToFit, input.differentCount() / PointsToSimplify);
  const bool isSimplified = asked < least;
  if (first || !mayLearnOtherwise(requested))
  {
    return learn(asked, report, watch, plan);
  }
  Reconstruction result = learn(isSimplified ? least : asked, report, watch, plan);
  if (!result.isComplete() ||
    (isSimplified ? isRight(result, asked) : !mayHaveRoundedCreases(result, input, requested)))
  {
    return result;
  }
  const std::uint64_t fewer = input.differentCount() / PointsThatTellCreases;
  Reconstruction other = learn(isSimplified ? asked : fewer, partOf(report, 1., 1.), {}, {});
  other.resumedIterations = result.resumedIterations;
  other.times.add(result.times);
  result.times = other.times;
  const bool isTaken = other.stopReason == StopReason::Cancelled ||
    (isSimplified ? !isCloser(result, other, asked) : isBetterRefined(other, result));
  return isTaken ? other : result;
}
}
