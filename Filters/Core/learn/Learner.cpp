// SPDX-License-Identifier: BSD-3-Clause
#include "learn/Learner.h"

#include "base/InterruptibleExecutor.h"
#include "learn/ParallelLearner.h"
#include "learn/SequentialLearner.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
std::unique_ptr<Learner> Learner::from(const Mesh& mesh, std::span<const float> weights,
  const PointCloud& cloud, const Parameters& parameters, const Executor& executor)
{
  if (ParallelLearner::isFor(parameters))
  {
    return std::make_unique<ParallelLearner>(cloud, parameters, mesh, weights, executor);
  }
  return std::make_unique<SequentialLearner>(cloud, parameters, mesh, weights, executor);
}

Learner::Learner(const Parameters& parameters, const Executor& executor)
  : parameters_(parameters)
  , executor_(executor.uninterrupted())
  , interruptible_(executor)
  , noiseFilter_(parameters)
  , winGain_(parameters)
  , nextAddition_(std::uint64_t(parameters.samplesPerAddition))
{
}

void Learner::learn(std::uint64_t sampleCount, const std::function<void()>& afterBatch)
{
  endOfTurn_ = counts_.iterations + sampleCount;
  finishTurn(afterBatch);
}

void Learner::finishTurn(const std::function<void()>& afterBatch)
{
  const auto goesOn = [this]
  { return isBatchOpen_ || (counts_.iterations < endOfTurn_ && !isComplete()); };
  while (goesOn())
  {
    if (!std::exchange(isBatchOpen_, true))
    {
      const std::uint64_t left = endOfTurn_ - counts_.iterations;
      learnBatch(std::size_t(std::min<std::uint64_t>(left, batchSize())));
    }
    try
    {
      endBatch();
    }
    catch (const Interrupted&)
    {
      return;
    }
    isBatchOpen_ = false;
    if (afterBatch)
    {
      afterBatch();
    }
  }
}

void Learner::begin(Step step) const
{
  if (watch_)
  {
    watch_(step);
  }
}

double Learner::patience() const
{
  const bool early = mesh().vertexCount() < std::size_t(parameters_.earlyVertices);
  return early ? parameters_.earlyPatience : 1.;
}

std::uint64_t Learner::removalInterval() const
{
  // Growth depends on the ratio of C_ec to C_vs, (6.18): patience is with both.
  return parameters_.filtersNoise()
    ? std::uint64_t(parameters_.additionsPerRemoval)
    : std::uint64_t(patience() * parameters_.removalPatience * double(mesh().vertexCount()));
}

double Learner::idleActivity() const
{
  return std::exp2(-parameters_.removalPatience / parameters_.counterHalfLife);
}

double Learner::busyActivity() const
{
  constexpr double TimesUsual = 3.;
  return TimesUsual * (parameters_.counterHalfLife / std::log(2.));
}

void Learner::updateDecay()
{
  // (9.4) with the current number of vertices.
  decay_ = parameters_.variant == Variant::Basic
    ? parameters_.counterDecay
    : std::exp2(-1. / (parameters_.counterHalfLife * double(mesh().vertexCount())));
}
}
