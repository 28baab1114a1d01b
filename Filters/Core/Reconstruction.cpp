// SPDX-License-Identifier: BSD-3-Clause
#include "Reconstruction.h"

#include "MeshBuilder.h"
#include "Orientation.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Often enough to end within milliseconds, rarely enough to cost nothing; large batches are not
/// cut for it.
constexpr std::uint64_t SamplesPerCheck = 4096;

/// Learns until a stopping rule is met; returns which.
StopReason learn(Learner& learner, const PointCloud& cloud, const Parameters& parameters,
  LearningCurve& curve, const Progress& progress)
{
  StoppingRules rules(cloud, parameters, learner.mesh().vertexCount());
  for (;;)
  {
    const StopReason reason =
      progress(rules.progress(learner)) ? rules.check(learner) : StopReason::Cancelled;
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
    learner.learn(samples);
  }
}
}

Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first)
{
  Reconstruction result;
  Learner learner = first ? Learner(cloud, parameters, *first) : Learner(cloud, parameters);
  result.stopReason = learn(learner, cloud, parameters, result.curve, progress);
  result.counts = learner.counts();

  learner.renumber();
  Mesh mesh = learner.mesh();
  orientOutwards(mesh);
  result.mesh = trianglesOf(mesh, cloud);
  result.normals = pointNormals(result.mesh);
  result.activities.reserve(mesh.vertexCount());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result.activities.push_back(learner.order().activity(v));
    if (learner.featureStrength())
    {
      result.featureStrengths.push_back(double((*learner.featureStrength())[v]));
    }
  }
  return result;
}
}
