// SPDX-License-Identifier: BSD-3-Clause
// Growth and topology learning: what Learner does now and then.
#include "learn/Learner.h"
#include "learn/ListOrder.h"
#include "mesh/EdgeFlips.h"
#include "mesh/HalfEdgeCollapse.h"
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
/// Bounds of the share of activity that a vertex keeps in a split.
constexpr double LeastShare = 0.05;
/// A vertex is busy if it is so many times as active as all would be if they won equally often: then
/// chance has the most active of a million at about twice that.
constexpr double BusyFactor = 3.;
}

double Learner::patience() const
{
  const bool early = mesh_.vertexCount() < std::size_t(parameters_.earlyVertices);
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

void Learner::nodeAddition()
{
  nextAddition_ +=
    std::max<std::uint64_t>(1, std::uint64_t(patience() * parameters_.samplesPerAddition));

  for (int attempt = 0; attempt < SplitAttempts; ++attempt)
  {
    const VertexIndex v = order_->top();
    const auto plan = parameters_.additionOperation == AdditionOperation::EdgeSplit
      ? planEdgeSplit(mesh_, v)
      : planVertexSplit(mesh_, v);
    if (!plan)
    {
      ++counts_.illegalOperations;
      order_->demoteTop();
      continue;
    }
    const VertexIndex added = mesh_.split(v, plan->first, plan->steps, plan->position);
    grid_.insert(added, plan->position);
    if (topology_)
    {
      topology_->boundaries().split(v, added);
    }
    const double area = restrictedVoronoiArea(mesh_, v);
    const double addedArea = restrictedVoronoiArea(mesh_, added);
    const double share = area + addedArea > 0. ? area / (area + addedArea) : 0.5;
    order_->split(v, added, std::clamp(share, LeastShare, 1. - LeastShare));
    if (featureStrength_)
    {
      featureStrength_->split(v, added);
    }
    if (!parameters_.filtersNoise())
    {
      hasWon_.resize(mesh_.indexEnd());
      hasWon_[added] = 1;
    }
    if (parameters_.edgeFlips)
    {
      counts_.flips += flipEdgesAround(mesh_, v);
      counts_.flips += flipEdgesAround(mesh_, added);
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
  if (order_->activity(order_->top()) < BusyFactor * usual)
  {
    nextAddition_ += std::uint64_t(parameters_.samplesPerAddition);
    return;
  }
  bool isRemoved = false;
  for (int attempt = 0; attempt < SplitAttempts && !isRemoved; ++attempt)
  {
    isRemoved = removeVertex(order_->bottom());
    if (!isRemoved)
    {
      ++counts_.illegalOperations;
      order_->promoteBottom();
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

std::uint64_t Learner::removalInterval() const
{
  // Growth depends on the ratio of C_ec to C_vs, (6.18): patience is with both.
  return parameters_.filtersNoise()
    ? std::uint64_t(parameters_.additionsPerRemoval)
    : std::uint64_t(patience() * parameters_.removalPatience * double(mesh_.vertexCount()));
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
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    if (mesh_.isAlive(v) && !hasWon_[v] && !removeVertex(v))
    {
      ++counts_.illegalOperations;
    }
    hasWon_[v] = 0;
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
    if (!removeVertex(order_->bottom()))
    {
      ++counts_.illegalOperations;
      order_->promoteBottom();
    }
  } while (++tried < limit && order_->isBottomBelow(threshold, expectedCount));
}

bool Learner::removeVertex(VertexIndex v)
{
  const VertexIndex kept = bestCollapse(mesh_, v);
  if (kept == NoVertex)
  {
    return removeStar(v);
  }
  if (topology_)
  {
    topology_->boundaries().collapse(v, kept);
  }
  const RemovalOperation operation = parameters_.removalOperation;
  if (operation == RemovalOperation::FullEdgeCollapse)
  {
    moveVertex(kept, positionAfterFullCollapse(mesh_, v, kept));
  }
  const Ring polygon = mesh_.ring(v);
  mesh_.collapse(v, kept);
  grid_.erase(v, mesh_.position(v));
  order_->erase(v);
  if (operation == RemovalOperation::VertexDelete)
  {
    counts_.flips += triangulateAnew(mesh_, polygon, kept);
  }
  if (parameters_.edgeFlips)
  {
    counts_.flips += flipEdgesAround(mesh_, kept);
  }
  ++counts_.removals;
  return true;
}

// --- Topology learning ---------------------------------------------------------------------------

void Learner::learnTopology()
{
  follow(topology_->learn(mesh_));
  nextTopology_ += topologyInterval();
  updateDecay();
}

std::uint64_t Learner::topologyInterval() const
{
  return std::uint64_t(parameters_.topologyPatience * double(mesh_.vertexCount())) + 1;
}

bool Learner::removeStar(VertexIndex v)
{
  if (!topology_ || !topology_->canRemoveStar(mesh_, v))
  {
    return false;
  }
  follow(topology_->removeStar(mesh_, v));
  return !mesh_.isAlive(v);
}

void Learner::follow(const TopologyLearning::Result& result)
{
  for (const VertexIndex v : result.removedVertices)
  {
    grid_.erase(v, mesh_.position(v));
    order_->erase(v);
  }
  hasWon_.resize(mesh_.indexEnd());
  counts_.removedTriangles += result.removedTriangles;
  counts_.mergedBoundaries += result.mergedBoundaries;
  counts_.filledBoundaries += result.filledBoundaries;
}

void Learner::enterListIfDue()
{
  if (!isListDue_ || mesh_.vertexCount() < std::size_t(parameters_.listVertices))
  {
    return;
  }
  std::vector<VertexIndex> laziestFirst(mesh_.vertexCount());
  for (VertexIndex& v : laziestFirst)
  {
    v = order_->bottom();
    order_->erase(v);
  }
  enterList(laziestFirst);
}

void Learner::enterList(std::span<const VertexIndex> laziestFirst)
{
  isListDue_ = false;
  winGain_.enterList();
  order_ = std::make_unique<ListOrder>(laziestFirst, parameters_.jumpFraction, parameters_.seed);
  order_->reserve(capacity_);
}

void Learner::updateDecay()
{
  // (9.4) with the current number of vertices.
  decay_ = parameters_.variant == Variant::Basic
    ? parameters_.counterDecay
    : std::exp2(-1. / (parameters_.counterHalfLife * double(mesh_.vertexCount())));
}
}
