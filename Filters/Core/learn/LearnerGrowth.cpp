// SPDX-License-Identifier: BSD-3-Clause
// The other half of the algorithm: growth and topology learning.
#include "learn/Learner.h"
#include "learn/ListOrder.h"
#include "mesh/VertexRemoval.h"
#include "mesh/VertexSplit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// Splits tried in a Node Addition before it is given up.
constexpr int SplitAttempts = 8;
/// A vertex is busy if it is so many times as active as all would be if they won equally often: then
/// chance has the most active of a million at about twice that.
constexpr double BusyFactor = 3.;
}

double Learner::patience() const
{
  const bool early = neuralMesh_.vertexCount() < std::size_t(parameters_.earlyVertices);
  return early ? parameters_.earlyPatience : 1.;
}

void Learner::grow()
{
  if (isAdditionDue())
  {
    begin(Step::NodeAddition);
    nodeAddition();
  }
  if (isRemovalDue())
  {
    begin(Step::NodeRemoval);
    nodeRemoval();
  }
  if (isTopologyDue())
  {
    begin(Step::TopologyLearning);
    learnTopology();
  }
  begin(Step::Basic);
}

void Learner::begin(Step step) const
{
  if (watch_)
  {
    watch_(step);
  }
}

/// Every C_vs samples. All counters are up to date, as (9.6) and (9.7) have it: they share one decay.
void Learner::nodeAddition()
{
  nextAddition_ +=
    std::max<std::uint64_t>(1, std::uint64_t(patience() * parameters_.samplesPerAddition));

  for (int attempt = 0; attempt < SplitAttempts; ++attempt)
  {
    const VertexIndex v = neuralMesh_.top();
    const auto plan = parameters_.additionOperation == AdditionOperation::EdgeSplit
      ? planEdgeSplit(mesh(), v)
      : planVertexSplit(mesh(), v);
    if (!plan)
    {
      ++counts_.illegalOperations;
      neuralMesh_.demoteTop();
      continue;
    }
    const VertexIndex added = neuralMesh_.split(v, *plan);
    if (parameters_.edgeFlips)
    {
      counts_.flips += neuralMesh_.flipEdgesAround(v);
      counts_.flips += neuralMesh_.flipEdgesAround(added);
    }
    ++counts_.additions;
    updateDecay();
    enterListIfDue();
    return;
  }
}

void Learner::wander()
{
  const double usual = parameters_.counterHalfLife / std::log(2.);
  if (order().activity(neuralMesh_.top()) < BusyFactor * usual)
  {
    nextAddition_ += std::uint64_t(parameters_.samplesPerAddition);
    return;
  }
  bool isRemoved = false;
  for (int attempt = 0; attempt < SplitAttempts && !isRemoved; ++attempt)
  {
    isRemoved = removeVertex(neuralMesh_.bottom());
    if (!isRemoved)
    {
      ++counts_.illegalOperations;
      neuralMesh_.promoteBottom();
    }
  }
  if (isRemoved)
  {
    nodeAddition();
  }
  else
  {
    nextAddition_ += std::uint64_t(parameters_.samplesPerAddition);
  }
}

/// C_nr additions; in the basic variant n C_ec samples.
std::uint64_t Learner::removalInterval() const
{
  // Growth depends on the ratio of C_ec to C_vs, (6.18): patience is with both.
  return parameters_.filtersNoise()
    ? std::uint64_t(parameters_.additionsPerRemoval)
    : std::uint64_t(patience() * parameters_.removalPatience * double(neuralMesh_.vertexCount()));
}

void Learner::nodeRemoval()
{
  if (parameters_.filtersNoise())
  {
    removeVertices();
  }
  else
  {
    removeIdleVertices();
  }
  nextRemoval_ += removalInterval();
  updateDecay();
}

void Learner::removeIdleVertices()
{
  const std::span<std::uint8_t> hasWon = neuralMesh_.values(*hasWon_);
  for (VertexIndex v = 0; v < mesh().indexEnd(); ++v)
  {
    if (mesh().isAlive(v) && !hasWon[v] && !removeVertex(v))
    {
      ++counts_.illegalOperations;
    }
    hasWon[v] = 0;
  }
}

void Learner::removeVertices()
{
  // alpha_n^(C_ec n), with alpha_n of (9.4).
  const double threshold = std::exp2(-parameters_.removalPatience / parameters_.counterHalfLife);
  // n_l of 11.3: how many there are on average, by which a list goes.
  const double expectedCount = parameters_.additionsPerRemoval * parameters_.samplesPerAddition *
    std::exp(-parameters_.removalPatience) / parameters_.removalPatience;
  const double limit = parameters_.removalLimit > 0.
    ? std::ceil(parameters_.removalLimit * parameters_.additionsPerRemoval)
    : std::numeric_limits<double>::infinity();
  double tried = 0.;
  do
  {
    if (!removeVertex(neuralMesh_.bottom()))
    {
      ++counts_.illegalOperations;
      neuralMesh_.promoteBottom();
    }
  } while (++tried < limit && neuralMesh_.isBottomBelow(threshold, expectedCount));
}

bool Learner::removeVertex(VertexIndex v)
{
  const VertexIndex kept = neuralMesh_.planCollapse(v);
  if (kept == NoVertex)
  {
    return removeStar(v);
  }
  const RemovalOperation operation = parameters_.removalOperation;
  if (operation == RemovalOperation::FullEdgeCollapse)
  {
    neuralMesh_.move(kept, positionAfterFullCollapse(mesh(), v, kept));
  }
  const Ring polygon = mesh().ring(v);
  neuralMesh_.collapse(v, kept);
  if (operation == RemovalOperation::VertexDelete)
  {
    counts_.flips += neuralMesh_.triangulateAnew(polygon, kept);
  }
  if (parameters_.edgeFlips)
  {
    counts_.flips += neuralMesh_.flipEdgesAround(kept);
  }
  ++counts_.removals;
  return true;
}

// --- Topology learning ---------------------------------------------------------------------------

void Learner::learnTopology()
{
  count(neuralMesh_.learnTopology(*topology_));
  nextTopology_ += topologyInterval();
  updateDecay();
}

/// n C_top samples.
std::uint64_t Learner::topologyInterval() const
{
  return std::uint64_t(parameters_.topologyPatience * double(neuralMesh_.vertexCount())) + 1;
}

bool Learner::removeStar(VertexIndex v)
{
  if (!topology_ || !topology_->canRemoveStar(mesh(), v))
  {
    return false;
  }
  count(neuralMesh_.removeStar(v, *topology_));
  return !mesh().isAlive(v);
}

void Learner::count(const TopologyLearning::Result& result)
{
  counts_.removedTriangles += result.removedTriangles;
  counts_.mergedBoundaries += result.mergedBoundaries;
  counts_.filledBoundaries += result.filledBoundaries;
}

void Learner::enterListIfDue()
{
  if (isListDue_ && neuralMesh_.vertexCount() >= std::size_t(parameters_.listVertices))
  {
    enterList();
  }
}

void Learner::enterList()
{
  isListDue_ = false;
  winGain_.enterList();
  neuralMesh_.replaceOrder(
    [this](std::span<const VertexIndex> laziestFirst) {
      return std::make_unique<ListOrder>(laziestFirst, parameters_.jumpFraction, parameters_.seed);
    });
}

void Learner::updateDecay()
{
  // (9.4) with the current number of vertices.
  decay_ = parameters_.variant == Variant::Basic
    ? parameters_.counterDecay
    : std::exp2(-1. / (parameters_.counterHalfLife * double(neuralMesh_.vertexCount())));
}
}
