// SPDX-License-Identifier: BSD-3-Clause
#include "learn/LearningCurve.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
constexpr std::uint64_t SamplesUntilFirstRow = 500;
constexpr std::uint64_t PartUntilNextRow = 20;

double regularRatio(const Mesh& mesh)
{
  std::size_t regular = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    regular += mesh.isAlive(v) && mesh.valenceExcess(v) == 0;
  }
  return double(regular) / double(mesh.vertexCount());
}
}

bool LearningCurve::isRowDue(const Learner& learner) const
{
  const std::uint64_t last = rows_.empty() ? 0 : rows_.back().counts.iterations;
  return learner.counts().iterations >=
    last + std::max(SamplesUntilFirstRow, last / PartUntilNextRow);
}

void LearningCurve::add(const Learner& learner, double unit, double seconds)
{
  if (!rows_.empty() && rows_.back().counts.iterations == learner.counts().iterations)
  {
    return;
  }
  rows_.push_back({
    .counts = learner.counts(),
    .vertices = learner.mesh().vertexCount(),
    .seconds = seconds,
    .sampleDistanceMean = unit * learner.sampleDistances().mean(),
    .sampleDistanceDeviation = unit * learner.sampleDistances().deviation(),
    .normalChangeMean = learner.normalChanges().mean(),
    .regularRatio = regularRatio(learner.mesh()),
  });
}

void LearningCurve::endWith(const Mesh& simplified)
{
  if (!rows_.empty())
  {
    rows_.back().vertices = simplified.vertexCount();
    rows_.back().regularRatio = regularRatio(simplified);
  }
}
}
