// SPDX-License-Identifier: BSD-3-Clause
#include "run/Run.h"

#include "mesh/QuadricSimplification.h"
#include "run/Warnings.h"
#include "start/OutlierClusters.h"

#include <algorithm>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the progress of the finish.
constexpr double PartBeforeRefinement = 0.6;
constexpr double PartBeforeDescription =
  (StartOfDescription - EndOfLearning) / (1. - EndOfLearning);
/// Of the progress of a description: error bars, and of the rest what comes before points are explained.
constexpr double PartOfBars = 0.75, PartBeforeExplanation = 0.3;

/// Learns until a stopping rule is met; returns which.
StopReason learnAll(LearningState state, Checkpoint& checkpoint, const PointCloud& cloud,
  const Parameters& parameters, const GrowthWatch& watch, const Progress& progress)
{
  auto& [learner, rules, curve, reason] = state;
  GrowthRecorder recorder(watch, learner, cloud, parameters.numberOfVertices);
  if (reason == StopReason::None)
  {
    learner.finishTurn();
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

/// The parameters of a run that learns so many vertices.
Parameters parametersFor(std::uint64_t vertices, const RunRequest& request)
{
  Parameters result = request.parameters;
  result.numberOfVertices = vertices;
  return learnable(result, request.cloud);
}
}

RunRequest requestWith(const RunRequest& request, const Parameters& parameters)
{
  return { request.cloud, parameters, request.first, request.executor, request.hints,
    request.explainsAll };
}

Run::Run(const RunRequest& request, const Progress& progress)
  : request_(request)
  , progress_(
      [this, &progress](double fraction)
      {
        fraction_ = fraction;
        return !isCancelled_ && !(isCancelled_ = !progress(fraction));
      })
  , interruptible_(request.executor, [this] { return progress_(fraction_); })
{
}

void Run::clean(const Parameters& parameters, double at)
{
  if (parameters.start == Start::OccupiedSpace && parameters.keepPieces > 0.)
  {
    cleaned_ = withoutClusters(request_.cloud, partOf(progress_, at, at), request_.executor);
  }
}

Beginning Run::begin(std::uint64_t vertices, ProgressPart part)
{
  if (request_.first)
  {
    return { request_.first, {}, {} };
  }
  const Parameters parameters = parametersFor(vertices, request_);
  clean(parameters, part.begin);
  return neuralmesh::begin(
    cloud(), parameters, partOf(progress_, part.begin, part.end), request_.executor);
}

std::optional<Beginning> Run::beginWithNarrowParts(std::uint64_t vertices, ProgressPart part)
{
  const Parameters parameters = parametersFor(vertices, request_);
  clean(parameters, part.begin);
  return neuralmesh::beginWithNarrowParts(
    cloud(), parameters, partOf(progress_, part.begin, part.end), request_.executor);
}

LearntRun Run::learn(std::uint64_t vertices, Beginning beginning, ProgressPart part,
  Checkpoint& checkpoint, const GrowthWatch& watch)
{
  const Parameters parameters = parametersFor(vertices, request_);
  const std::optional<GapPlan> gaps = beginning.gaps;
  Reconstruction result;
  result.isFromGrid = beginning.isFromGrid;
  result.times.enter(Phase::Learning);
  std::unique_ptr<Learner> learner =
    learnerFrom(std::move(beginning), cloud(), parameters, interruptible_);
  StoppingRules rules(cloud(), parameters, learner->mesh().vertexCount());
  LearningState state{ *learner, rules, result.curve };
  result.resumedIterations = checkpoint.resume(state, !isCancelled_);
  result.stopReason = learnAll(
    state, checkpoint, cloud(), parameters, watch, partOf(progress_, part.begin, part.end));
  result.counts = learner->counts();
  learner->compact();
  LearntMesh learnt = learner->learntMesh();
  result.times.leave();
  const bool isLearnt = request_.first || result.counts.iterations > 0;
  const bool mayTakeLonger =
    result.resumedIterations > 0 && result.stopReason == StopReason::Vertices;
  return { std::move(result), std::move(learnt), rules, vertices, gaps, isLearnt, mayTakeLonger };
}

Progress Run::inTime(const LearntRun& run, const Progress& progress) const
{
  const double limit = run.mayTakeLonger ? 0. : request_.parameters.timeLimit;
  return [limit, &rules = run.rules, progress](double fraction)
  { return progress(fraction) && !(limit > 0. && rules.seconds() >= limit); };
}

StopReason Run::whyEnded() const
{
  return isCancelled_ ? StopReason::Cancelled : StopReason::TimeLimit;
}

void Run::fit(LearntRun& run, std::uint64_t asked, const Progress& progress)
{
  Reconstruction& result = run.result;
  LearntMesh& learnt = run.learnt;
  const std::uint64_t vertices = run.vertices;
  const Parameters parameters = parametersFor(vertices, request_);
  const auto most = std::size_t(std::min(vertices, asked));
  const std::size_t there = learnt.mesh.vertexCount();
  // A first mesh may have all vertices already: then it is fitted as it is.
  const std::size_t finished = result.stopReason != StopReason::Vertices ? there
    : request_.first                                                     ? std::max(there, most)
                                                                         : most;
  const bool isRefined = vertices < asked && finished == most;
  const Progress finishing = inTime(run, progress);
  const double endOfFirst = isRefined ? PartBeforeRefinement : 1.;
  result.finish = unlessInterrupted(
    [&]
    {
      return neuralmesh::finish(learnt, cloud(), parameters, run.gaps, finished,
        partOf(finishing, 0., endOfFirst), interruptible_, request_.hints);
    });
  if (result.finish && isRefined)
  {
    const auto refined = std::size_t(parametersFor(asked, request_).numberOfVertices);
    if (!refineFinished(learnt, cloud(), parameters, refined, *result.finish,
          partOf(finishing, endOfFirst, 1.), interruptible_))
    {
      result.finish.reset();
    }
    result.curve.endWith(learnt.mesh);
  }
  if (!result.finish)
  {
    result.stopReason = whyEnded();
  }
}

bool Run::make(LearntRun& run, std::uint64_t asked, ProgressPart part)
{
  Reconstruction& result = run.result;
  const bool isSimplified = !request_.first && run.learnt.mesh.vertexCount() > asked;
  if (request_.parameters.fitRounds > 0 && result.isComplete() && run.isLearnt)
  {
    fit(run, asked, partOf(progress_, part.begin, part.end));
  }
  if (isSimplified)
  {
    // If there was no time to finish it.
    simplifyByQuadrics(run.learnt.mesh, std::size_t(std::min(run.vertices, asked)));
    result.curve.endWith(run.learnt.mesh);
  }
  return result.isComplete();
}

template <typename Remake>
bool Run::remake(LearntRun& run, std::uint64_t asked, ProgressPart part, const Remake& remakeMesh)
{
  Reconstruction& result = run.result;
  result.finish = unlessInterrupted(
    [&]
    {
      return remakeMesh(run.learnt, *result.finish, cloud(), parametersFor(asked, request_),
        std::size_t(asked), inTime(run, partOf(progress_, part.begin, part.end)), interruptible_,
        request_.hints);
    });
  if (!result.finish)
  {
    result.stopReason = whyEnded();
    if (result.stopReason == StopReason::TimeLimit)
    {
      // The limit may have ended the simplification.
      simplifyByQuadrics(run.learnt.mesh, std::size_t(asked));
    }
  }
  result.curve.endWith(run.learnt.mesh);
  return result.isComplete();
}

bool Run::makeAgain(LearntRun& run, std::uint64_t asked, ProgressPart part)
{
  return remake(run, asked, part, finishAgain);
}

bool Run::makeToSimplify(LearntRun& run, ProgressPart part)
{
  Reconstruction& result = run.result;
  result.finish = unlessInterrupted(
    [&]
    {
      return finishToSimplify(run.learnt, cloud(), parametersFor(run.vertices, request_), run.gaps,
        inTime(run, partOf(progress_, part.begin, part.end)), interruptible_, request_.hints);
    });
  if (!result.finish)
  {
    result.stopReason = whyEnded();
  }
  return result.isComplete();
}

bool Run::makeSimplified(LearntRun& run, std::uint64_t asked, ProgressPart part)
{
  return remake(run, asked, part, finishSimplified);
}

Reconstruction Run::describe(LearntRun run, std::uint64_t asked, ProgressPart part)
{
  Reconstruction& result = run.result;
  result.times.enter(Phase::Finish);
  const Parameters parameters = parametersFor(run.vertices, request_);
  const double endOfBars =
    parameters.computeUncertainty ? part.begin + PartOfBars * (part.end - part.begin) : part.begin;
  const Progress telling = inTime(run, partOf(progress_, part.begin, endOfBars));
  const auto tells = [&]
  {
    return tellUncertainty(
      run.learnt, cloud(), parameters, result, telling, interruptible_, request_.hints);
  };
  if (parameters.computeUncertainty && result.finish && !unlessInterrupted(tells))
  {
    result.stopReason = whyEnded();
  }
  const bool isWhole = result.stopReason != StopReason::Cancelled;
  const double middle = endOfBars + PartBeforeExplanation * (part.end - endOfBars);
  const Progress describing = partOf(progress_, endOfBars, middle);
  const Progress explaining = partOf(progress_, middle, part.end);
  neuralmesh::describe(std::move(run.learnt), cloud(), isWhole ? &request_.cloud : nullptr,
    request_.hints, result, describing, interruptible_);
  const auto explains = [&]
  {
    return explainPoints(request_.cloud, cleaned_ ? &*cleaned_ : nullptr,
      request_.parameters.keepPieces, request_.explainsAll, result, explaining, interruptible_);
  };
  if (isWhole && !unlessInterrupted(explains))
  {
    result.stopReason = StopReason::Cancelled;
    result.quality.reset();
    result.explanation.reset();
    result.finish.reset();
  }
  Parameters requested = request_.parameters;
  requested.numberOfVertices = asked;
  result.warnings = warningsOf(result, request_.cloud, requested);
  result.times.leave();
  return std::move(run.result);
}

Reconstruction Run::finish(LearntRun run, std::uint64_t asked, ProgressPart part,
  const std::function<void(const LearntRun&)>& made)
{
  const double partOfFit =
    request_.parameters.computeUncertainty ? PartBeforeUncertainty : PartBeforeDescription;
  const double middle = part.begin + partOfFit * (part.end - part.begin);
  run.result.times.enter(Phase::Finish);
  make(run, asked, { part.begin, middle });
  run.result.times.leave();
  if (made)
  {
    made(run);
  }
  return describe(std::move(run), asked, { middle, part.end });
}
}
