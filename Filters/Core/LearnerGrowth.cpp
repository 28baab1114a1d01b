// SPDX-License-Identifier: BSD-3-Clause
// Growth and topology learning: what Learner does now and then.
#include "EdgeFlips.h"
#include "HalfEdgeCollapse.h"
#include "Learner.h"
#include "ListOrder.h"
#include "VertexRemoval.h"
#include "VertexSplit.h"

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
  const bool early = this->mesh_.vertexCount() < std::size_t(this->parameters_.earlyVertices);
  return early ? this->parameters_.earlyPatience : 1.;
}

void Learner::grow()
{
  if (this->isAdditionDue())
  {
    this->begin(Step::NodeAddition);
    this->nodeAddition();
  }
  if (this->isRemovalDue())
  {
    this->begin(Step::NodeRemoval);
    this->nodeRemoval();
  }
  if (this->isTopologyDue())
  {
    this->begin(Step::TopologyLearning);
    this->learnTopology();
  }
  this->begin(Step::Basic);
}

void Learner::begin(Step step) const
{
  if (this->watch_)
  {
    this->watch_(step);
  }
}

void Learner::nodeAddition()
{
  this->nextAddition_ += std::max<std::uint64_t>(
    1, std::uint64_t(this->patience() * this->parameters_.samplesPerAddition));

  for (int attempt = 0; attempt < SplitAttempts; ++attempt)
  {
    const VertexIndex v = this->order_->top();
    const auto plan = this->parameters_.additionOperation == AdditionOperation::EdgeSplit
      ? planEdgeSplit(this->mesh_, v)
      : planVertexSplit(this->mesh_, v);
    if (!plan)
    {
      ++this->counts_.illegalOperations;
      this->order_->demoteTop();
      continue;
    }
    const VertexIndex added = this->mesh_.split(v, plan->first, plan->steps, plan->position);
    this->grid_.insert(added, plan->position);
    if (this->topology_)
    {
      this->topology_->boundaries().split(v, added);
    }
    const double area = restrictedVoronoiArea(this->mesh_, v);
    const double addedArea = restrictedVoronoiArea(this->mesh_, added);
    const double share = area + addedArea > 0. ? area / (area + addedArea) : 0.5;
    this->order_->split(v, added, std::clamp(share, LeastShare, 1. - LeastShare));
    if (this->featureStrength_)
    {
      this->featureStrength_->split(v, added);
    }
    if (!this->parameters_.filtersNoise())
    {
      this->hasWon_.resize(this->mesh_.indexEnd());
      this->hasWon_[added] = 1;
    }
    if (this->parameters_.edgeFlips)
    {
      this->counts_.flips += flipEdgesAround(this->mesh_, v);
      this->counts_.flips += flipEdgesAround(this->mesh_, added);
    }
    ++this->counts_.additions;
    this->updateDecay();
    this->enterListIfDue();
    return;
  }
}

void Learner::wander()
{
  const double usual = this->parameters_.counterHalfLife / std::log(2.);
  if (this->order_->activity(this->order_->top()) < BusyFactor * usual)
  {
    this->nextAddition_ += std::uint64_t(this->parameters_.samplesPerAddition);
    return;
  }
  bool isRemoved = false;
  for (int attempt = 0; attempt < SplitAttempts && !isRemoved; ++attempt)
  {
    isRemoved = this->removeVertex(this->order_->bottom());
    if (!isRemoved)
    {
      ++this->counts_.illegalOperations;
      this->order_->promoteBottom();
    }
  }
  if (isRemoved)
  {
    this->nodeAddition();
  }
  else
  {
    this->nextAddition_ += std::uint64_t(this->parameters_.samplesPerAddition);
  }
}

std::uint64_t Learner::removalInterval() const
{
  // Growth depends on the ratio of C_ec to C_vs, (6.18): patience is with both.
  return this->parameters_.filtersNoise()
    ? std::uint64_t(this->parameters_.additionsPerRemoval)
    : std::uint64_t(
        this->patience() * this->parameters_.removalPatience * double(this->mesh_.vertexCount()));
}

void Learner::nodeRemoval()
{
  if (this->parameters_.filtersNoise())
  {
    this->removeVertices();
  }
  else
  {
    this->removeIdleVertices();
  }
  this->nextRemoval_ += this->removalInterval();
  this->updateDecay();
}

void Learner::removeIdleVertices()
{
  for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
  {
    if (this->mesh_.isAlive(v) && !this->hasWon_[v] && !this->removeVertex(v))
    {
      ++this->counts_.illegalOperations;
    }
    this->hasWon_[v] = 0;
  }
}

void Learner::removeVertices()
{
  // alpha_n^(C_ec n), with alpha_n of (9.4).
  const double threshold =
    std::exp2(-this->parameters_.removalPatience / this->parameters_.counterHalfLife);
  // n_l of 11.3: how many there are on average, by which a list goes.
  const double expectedCount = this->parameters_.additionsPerRemoval *
    this->parameters_.samplesPerAddition * std::exp(-this->parameters_.removalPatience) /
    this->parameters_.removalPatience;
  const double limit = this->parameters_.removalLimit > 0.
    ? std::ceil(this->parameters_.removalLimit * this->parameters_.additionsPerRemoval)
    : std::numeric_limits<double>::infinity();
  double tried = 0.;
  do
  {
    if (!this->removeVertex(this->order_->bottom()))
    {
      ++this->counts_.illegalOperations;
      this->order_->promoteBottom();
    }
  } while (++tried < limit && this->order_->isBottomBelow(threshold, expectedCount));
}

bool Learner::removeVertex(VertexIndex v)
{
  const VertexIndex kept = bestCollapse(this->mesh_, v);
  if (kept == NoVertex)
  {
    return this->removeStar(v);
  }
  if (this->topology_)
  {
    this->topology_->boundaries().collapse(v, kept);
  }
  const RemovalOperation operation = this->parameters_.removalOperation;
  if (operation == RemovalOperation::FullEdgeCollapse)
  {
    this->moveVertex(kept, positionAfterFullCollapse(this->mesh_, v, kept));
  }
  const Ring polygon = this->mesh_.ring(v);
  this->mesh_.collapse(v, kept);
  this->grid_.erase(v, this->mesh_.position(v));
  this->order_->erase(v);
  if (operation == RemovalOperation::VertexDelete)
  {
    this->counts_.flips += triangulateAnew(this->mesh_, polygon, kept);
  }
  if (this->parameters_.edgeFlips)
  {
    this->counts_.flips += flipEdgesAround(this->mesh_, kept);
  }
  ++this->counts_.removals;
  return true;
}

// --- Topology learning ---------------------------------------------------------------------------

void Learner::learnTopology()
{
  this->follow(this->topology_->learn(this->mesh_));
  this->nextTopology_ += this->topologyInterval();
  this->updateDecay();
}

std::uint64_t Learner::topologyInterval() const
{
  return std::uint64_t(this->parameters_.topologyPatience * double(this->mesh_.vertexCount())) + 1;
}

bool Learner::removeStar(VertexIndex v)
{
  if (!this->topology_ || !this->topology_->canRemoveStar(this->mesh_, v))
  {
    return false;
  }
  this->follow(this->topology_->removeStar(this->mesh_, v));
  return !this->mesh_.isAlive(v);
}

void Learner::follow(const TopologyLearning::Result& result)
{
  for (const VertexIndex v : result.removedVertices)
  {
    this->grid_.erase(v, this->mesh_.position(v));
    this->order_->erase(v);
  }
  this->hasWon_.resize(this->mesh_.indexEnd());
  this->counts_.removedTriangles += result.removedTriangles;
  this->counts_.mergedBoundaries += result.mergedBoundaries;
  this->counts_.filledBoundaries += result.filledBoundaries;
}

void Learner::enterListIfDue()
{
  if (!this->isListDue_ || this->mesh_.vertexCount() < std::size_t(this->parameters_.listVertices))
  {
    return;
  }
  std::vector<VertexIndex> laziestFirst(this->mesh_.vertexCount());
  for (VertexIndex& v : laziestFirst)
  {
    v = this->order_->bottom();
    this->order_->erase(v);
  }
  this->enterList(laziestFirst);
}

void Learner::enterList(std::span<const VertexIndex> laziestFirst)
{
  this->isListDue_ = false;
  this->winGain_.enterList();
  this->order_ = std::make_unique<ListOrder>(
    laziestFirst, this->parameters_.jumpFraction, this->parameters_.seed);
  this->order_->reserve(this->capacity_);
}

void Learner::updateDecay()
{
  // (9.4) with the current number of vertices.
  this->decay_ = this->parameters_.variant == Variant::Basic
    ? this->parameters_.counterDecay
    : std::exp2(-1. / (this->parameters_.counterHalfLife * double(this->mesh_.vertexCount())));
}
}
