// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"

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

Reconstruction reconstruct(const PointCloud& input, const Parameters& requested,
  const Progress& report, const std::optional<Mesh>& first, const GrowthWatch& watch,
  const CheckpointPlan& plan, const Executor& executor, const OrientationHints& hints,
  bool explainsAll)
{
  Reconstruction result;
  // Once the caller has ended the run, it is asked no more.
  bool isCancelled = false;
  const Progress progress = [&](double fraction)
  { return !isCancelled && !(isCancelled = !report(fraction)); };
  Checkpoint checkpoint(plan, input, requested);

  result.times.enter(Phase::Start);
  const Parameters parameters = learnable(requested, input);
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
  std::optional<Learner> learner(learnerFrom(std::move(beginning), cloud, parameters, executor));
  StoppingRules rules(cloud, parameters, learner->mesh().vertexCount());
  LearningState state{ *learner, rules, result.curve };
  result.resumedIterations = checkpoint.resume(state, !isCancelled);
  result.stopReason = learnAll(
    state, checkpoint, cloud, parameters, watch, partOf(progress, startOfLearning, endOfLearning));
  result.counts = learner->counts();
  learner->compact();
  LearntMesh learnt = learner->learntMesh();
  learner.reset();

  result.times.enter(Phase::Finish);
  // A first mesh may have all vertices already: then it is fitted as it is.
  if (parameters.fitRounds > 0 && result.isComplete() && (first || result.counts.iterations > 0))
  {
    const std::size_t vertices = result.stopReason == StopReason::Vertices
      ? std::max(std::size_t(requested.numberOfVertices), learnt.mesh.vertexCount())
      : learnt.mesh.vertexCount();
    const Progress finishing = partOf(progress, endOfLearning, 1.);
    result.finish = finish(
      learnt, cloud, parameters, gaps, vertices,
      [&](double fraction)
      {
        const bool isTimeOver =
          parameters.timeLimit > 0. && rules.seconds() >= parameters.timeLimit;
        return finishing(fraction) && !isTimeOver;
      },
      executor);
    if (!result.finish)
    {
      result.stopReason = isCancelled ? StopReason::Cancelled : StopReason::TimeLimit;
    }
  }
  describe(std::move(learnt), cloud, result.stopReason == StopReason::Cancelled ? nullptr : &input,
    hints, result, executor);
  if (result.stopReason != StopReason::Cancelled)
  {
    explainPoints(
      input, cleaned ? &*cleaned : nullptr, requested.keepPieces, explainsAll, result, executor);
  }
  result.warnings = warningsOf(result, input);
  result.times.leave();
  return result;
}
}
