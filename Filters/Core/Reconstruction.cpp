// SPDX-License-Identifier: BSD-3-Clause
#include "Reconstruction.h"

#include "Orientation.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Often enough to end within milliseconds, rarely enough to cost nothing.
constexpr std::uint64_t SamplesPerCheck = 4096;

StopReason learn(
  Learner& learner, StoppingRules& rules, std::uint64_t maximumIterations, const Progress& progress)
{
  for (;;)
  {
    const StopReason reason = rules.check(learner);
    if (reason != StopReason::None)
    {
      return reason;
    }
    if (!progress(rules.progress(learner)))
    {
      return StopReason::Cancelled;
    }
    std::uint64_t samples = SamplesPerCheck;
    if (maximumIterations > 0)
    {
      samples = std::min(samples, maximumIterations - learner.counts().iterations);
    }
    learner.learn(samples);
  }
}

TriangleMesh toInput(const Mesh& mesh, const PointCloud& cloud)
{
  TriangleMesh result;
  result.points.reserve(mesh.vertexCount());
  result.triangles.reserve(mesh.triangleCount());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result.points.push_back(cloud.toInput(mesh.position(v)));
  }
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c) {
      result.triangles.push_back({ a, b, c });
    });
  return result;
}
}

Reconstruction reconstruct(
  const PointCloud& cloud, const Parameters& parameters, const Progress& progress)
{
  Reconstruction result;
  Learner learner(cloud, parameters);
  StoppingRules rules(cloud, parameters);
  result.stopReason = learn(learner, rules, parameters.maximumIterations, progress);
  result.counts = learner.counts();

  learner.renumber();
  Mesh mesh = learner.mesh();
  orientOutwards(mesh);
  result.mesh = toInput(mesh, cloud);
  result.normals = pointNormals(result.mesh);
  result.activities.reserve(mesh.vertexCount());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    result.activities.push_back(learner.order().activity(v));
  }
  return result;
}
}
