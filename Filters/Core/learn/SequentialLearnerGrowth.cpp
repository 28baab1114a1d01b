// SPDX-License-Identifier: BSD-3-Clause
// The other half of the algorithm: growth and topology learning.
#include "learn/ListOrder.h"
#include "learn/SequentialLearner.h"
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
}

void SequentialLearner::grow()
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

/// Every C_vs samples. All counters are up to date, as (9.6) and (9.7) have it: they share one decay.
void SequentialLearner::nodeAddition()
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

void SequentialLearner::wander()
{
  if (order().activity(neuralMesh_.top()) < busyActivity())
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

void SequentialLearner::nodeRemoval()
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

void SequentialLearner::removeIdleVertices()
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

void SequentialLearner::removeVertices()
{
  const double threshold = idleActivity();
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

bool SequentialLearner::removeVertex(VertexIndex v)
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

void SequentialLearner::learnTopology()
{
  count(neuralMesh_.learnTopology(*topology_));
  nextTopology_ += topologyInterval();
  updateDecay();
}

/// n C_top samples.
std::uint64_t SequentialLearner::topologyInterval() const
{
  return std::uint64_t(parameters_.topologyPatience * double(neuralMesh_.vertexCount())) + 1;
}

bool SequentialLearner::removeStar(VertexIndex v)
{
  if (!topology_ || !topology_->canRemoveStar(mesh(), v))
  {
    return false;
  }
  count(neuralMesh_.removeStar(v, *topology_));
  return !mesh().isAlive(v);
}

void SequentialLearner::count(const TopologyLearning::Result& result)
{
  counts_.removedTriangles += result.removedTriangles;
  counts_.mergedBoundaries += result.mergedBoundaries;
  counts_.filledBoundaries += result.filledBoundaries;
}

void SequentialLearner::enterListIfDue()
{
  if (isListDue_ && neuralMesh_.vertexCount() >= std::size_t(parameters_.listVertices))
  {
    enterList();
  }
}

void SequentialLearner::enterList()
{
  isListDue_ = false;
  winGain_.enterList();
  neuralMesh_.replaceOrder(
    [this](std::span<const VertexIndex> laziestFirst) {
      return std::make_unique<ListOrder>(laziestFirst, parameters_.jumpFraction, parameters_.seed);
    });
}
}
