// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"

#include "cloud/MeshBuilder.h"
#include "mesh/Orientation.h"
#include "start/CurvatureDensity.h"
#include "start/FirstSurface.h"
#include "start/OutlierClusters.h"

#include <algorithm>
#include <ctime>

namespace neuralmesh
{
namespace
{
/// Often enough to end within milliseconds, rarely enough to cost nothing; large batches are not
/// cut for it.
constexpr std::uint64_t SamplesPerCheck = 4096;

/// With less the mesh would follow single points, not the surface.
constexpr std::size_t PointsPerVertex = 2;
constexpr std::size_t LeastLearnt = 100;

/// Learns until a stopping rule is met; returns which.
StopReason learn(LearningState state, Checkpoint& checkpoint, const PointCloud& cloud,
  const Parameters& parameters, const GrowthWatch& watch, const Progress& progress)
{
  auto& [learner, rules, curve, reason] = state;
  GrowthRecorder recorder(watch, learner, cloud, parameters.numberOfVertices);
  for (;;)
  {
    if (reason == StopReason::None)
    {
      reason = progress(rules.progress(learner)) ? rules.check(learner) : StopReason::Cancelled;
    }
    checkpoint.look(state);
    if (reason != StopReason::None || curve.isRowDue(learner))
    {
      curve.add(learner, cloud.unit(), rules.seconds());
    }
    if (reason != StopReason::None)
    {
      return reason;
    }
    std::uint64_t samples = std::max<std::uint64_t>(SamplesPerCheck, learner.batchSize());
    if (parameters.maximumIterations > 0)
    {
      samples = std::min(samples, parameters.maximumIterations - learner.counts().iterations);
    }
    learner.learn(samples, [&recorder] { recorder.look(); });
  }
}

/// What is known before learning.
struct Beginning
{
  std::optional<PointCloud> cloud;   ///< without clusters of outliers; nothing if there are none
  std::optional<Mesh> mesh;          ///< to start from; nothing: a tetrahedron
  std::optional<double> bridgeWidth; ///< for openDataGaps(); nothing: gaps stay closed
  std::vector<float> weights;        ///< to draw samples by; empty: those of the cloud
};

Beginning beginFromSpace(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const Executor& executor)
{
  Beginning result;
  result.cloud = withoutClusters(cloud);
  const PointCloud& used = result.cloud ? *result.cloud : cloud;
  auto surface = firstSurface(
    used, firstVertices(parameters.numberOfVertices), parameters.boundaries, progress, executor);
  if (!surface)
  {
    return result;
  }
  result.mesh = std::move(surface->mesh);
  if (parameters.boundaries == Boundaries::Keep)
  {
    result.bridgeWidth = surface->bridgeWidth;
  }
  // The normal-based variant has a way of its own to be dense where the surface bends; and feature
  // strength tells edges best where vertices are spread evenly.
  if (parameters.curvatureDensity > 0. && parameters.variant != Variant::NormalBased &&
    !parameters.computeFeatureStrength)
  {
    result.weights = curvatureDensity(used, *result.mesh, parameters.curvatureDensity, executor);
  }
  return result;
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

double cpuSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

Reconstruction reconstruct(const PointCloud& all, const Parameters& wanted, const Progress& tell,
  const std::optional<Mesh>& first, const GrowthWatch& watch, const CheckpointPlan& plan,
  const Executor& executor)
{
  Reconstruction result;
  // Once the caller has ended the run, it is asked no more.
  bool isCancelled = false;
  const Progress progress = [&](double fraction)
  { return !isCancelled && !(isCancelled = !tell(fraction)); };
  Checkpoint checkpoint(plan, all, wanted);
  const double begin = cpuSeconds();
  const Parameters parameters = first ? wanted : learnable(wanted, all);
  const bool startsFromSpace = !first && parameters.start == Start::OccupiedSpace;
  Beginning beginning = startsFromSpace
    ? beginFromSpace(all, parameters, partOf(progress, 0., StartOfLearning), executor)
    : Beginning{ {}, first, {}, {} };
  const PointCloud& cloud = beginning.cloud ? *beginning.cloud : all;
  const double learningBegin = cpuSeconds();
  Learner learner = beginning.mesh
    ? Learner(cloud, parameters, *beginning.mesh, beginning.weights, executor)
    : Learner(cloud, parameters, executor);
  // The learner has made of them what it needs.
  beginning.mesh.reset();
  std::vector<float>().swap(beginning.weights);
  const double startOfLearning = startsFromSpace ? StartOfLearning : 0.;
  const double endOfLearning = parameters.fitRounds > 0 ? EndOfLearning : 1.;
  StoppingRules rules(cloud, parameters, learner.mesh().vertexCount());
  LearningState state{ learner, rules, result.curve };
  result.resumedIterations = checkpoint.resume(state, !isCancelled);
  result.stopReason = learn(
    state, checkpoint, cloud, parameters, watch, partOf(progress, startOfLearning, endOfLearning));
  result.counts = learner.counts();

  learner.renumber();
  const double learningEnd = cpuSeconds();
  Mesh mesh = learner.mesh();
  const bool isLearnt = result.stopReason == StopReason::Vertices;
  Finish finish(cloud, mesh, parameters, beginning.bridgeWidth,
    isLearnt ? std::size_t(wanted.numberOfVertices) : mesh.vertexCount(), executor);
  if (parameters.fitRounds > 0 && result.isComplete() && result.counts.iterations > 0)
  {
    const Progress finishing = partOf(progress, endOfLearning, 1.);
    const bool isDone = finish.run(
      [&](double fraction)
      {
        const bool isTimeOver =
          parameters.timeLimit > 0. && rules.seconds() >= parameters.timeLimit;
        return finishing(fraction) && !isTimeOver;
      });
    if (isDone)
    {
      result.finish = finish.report();
    }
    else
    {
      result.stopReason = isCancelled ? StopReason::Cancelled : StopReason::TimeLimit;
    }
  }
  orientOutwards(mesh);
  result.mesh = trianglesOf(mesh, cloud);
  result.normals = pointNormals(result.mesh);
  result.activities.reserve(mesh.vertexCount());
  for (const VertexIndex learnt : finish.origins())
  {
    result.activities.push_back(learner.order().activity(learnt));
    if (learner.featureStrength())
    {
      result.featureStrengths.push_back(double((*learner.featureStrength())[learnt]));
    }
  }
  if (result.stopReason != StopReason::Cancelled)
  {
    result.quality = measureQuality(all, mesh, result.mesh);
  }
  result.surface = std::move(mesh);
  result.startSeconds = learningBegin - begin;
  result.learningSeconds = learningEnd - learningBegin;
  result.finishSeconds = cpuSeconds() - learningEnd;
  return result;
}
}
