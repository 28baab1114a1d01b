// SPDX-License-Identifier: BSD-3-Clause
#include "Learner.h"

#include "EdgeFlips.h"
#include "ExactOrder.h"
#include "HalfEdgeCollapse.h"
#include "ListOrder.h"
#include "Morton.h"
#include "Smoothing.h"
#include "VertexSplit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
/// A batch is so small a part of the mesh that hardly any vertex wins twice in it.
constexpr std::size_t VerticesPerSampleOfBatch = 8;
/// The window of the statistics spans about four batches: batches are sorted, so the last so many
/// samples would all lie in one corner of the cloud.
constexpr std::size_t ObservationsPerBatch = 250;
constexpr std::size_t PrefetchDistance = 8;
/// Meshes up to this size stay in the cache by themselves, more or less.
constexpr std::size_t VerticesInCache = 1 << 15;

/// Where outliers are rejected, distances count as at most so many epsilon_t in the statistics:
/// otherwise outliers raise the very limit beyond which they are rejected.
constexpr float ObservationLimit = 1.5f;
/// How often the window is filled before a first mesh is learnt, and with how many samples at most:
/// each time the limit sinks, until it tells outliers.
constexpr int FirstObservations = 8;
constexpr std::size_t MostFirstSamples = 1 << 16;

/// Width of a grid cell in mean edges.
constexpr float EdgesPerCell = 2.f;
/// Vertices are renumbered and the grid is made anew whenever there are so many times more.
constexpr double GrowthUntilRenumbering = 1.4;

/// Splits tried in a Node Addition before it is given up.
constexpr int SplitAttempts = 8;
/// Bounds of the share of activity that a vertex keeps in a split.
constexpr double LeastShare = 0.05;

/// Radius of the first tetrahedron; the bulk of the cloud has a diagonal of 1.
constexpr float FirstRadius = 0.1f;

Vector4 meanOf(std::span<const Vector4> points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Vector4 point : points)
  {
    sum += point.toDouble();
  }
  return Vector4(Eigen::Vector3d(sum / double(points.size())));
}

float meanEdgeLength(const Mesh& mesh)
{
  double sum = 0.;
  std::size_t count = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      sum += std::sqrt(squaredNorm(mesh.position(neighbor) - mesh.position(v)));
      ++count;
    }
  }
  return float(sum / double(count));
}

Mesh firstTetrahedron(const PointCloud& cloud)
{
  const Vector4 center = max(min(meanOf(cloud.points()), cloud.bulkMax()), cloud.bulkMin());
  return Mesh::tetrahedron(center, FirstRadius);
}

/// Counters with which no vertex counts as idle before it could win: with counters of zero, most of
/// a large mesh would be removed at once.
std::unique_ptr<ActivityOrder> orderAfterOneWin(std::size_t count)
{
  auto order = std::make_unique<ExactOrder>(count);
  for (std::size_t v = 0; v < count; ++v)
  {
    order->win(VertexIndex(v), 1., 1.);
  }
  return order;
}
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters)
  : Learner(cloud, parameters, firstTetrahedron(cloud), std::make_unique<ExactOrder>(4))
{
  this->isListDue_ = parameters.order == Order::List;
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh)
  : Learner(cloud, parameters, mesh, orderAfterOneWin(mesh.indexEnd()))
{
  this->isListDue_ = parameters.order == Order::List;
  this->enterListIfDue();
  this->observeFirstMesh();
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, Mesh mesh,
  std::unique_ptr<ActivityOrder> order)
  : parameters_(parameters)
  , mesh_(std::move(mesh))
  , order_(std::move(order))
  , samples_(cloud.points(), parameters.seed)
  , sampleDistances_(std::size_t(parameters.noiseWindow))
  , boxMin_(cloud.bulkMin())
  , boxMax_(cloud.bulkMax())
  , hasWon_(mesh_.indexEnd(), 1)
{
  this->renumber();
  this->nextAddition_ = std::uint64_t(this->parameters_.samplesPerAddition);
  this->nextRemoval_ = this->removalInterval();
  if (this->parameters_.topologyLearning)
  {
    this->topology_.emplace(this->mesh_, this->parameters_);
    this->boundarySmoothing_ = parameters.topologyRules == TopologyRules::Thesis
      ? BoundarySmoothing::Everywhere
      : BoundarySmoothing::Along;
    this->nextTopology_ = this->topologyInterval();
  }
  this->updateDecay();
}

void Learner::learn(std::uint64_t sampleCount)
{
  const std::uint64_t end = this->counts_.iterations + sampleCount;
  while (this->counts_.iterations < end && !this->hasAllVertices())
  {
    const std::uint64_t left = end - this->counts_.iterations;
    this->learnBatch(std::size_t(std::min<std::uint64_t>(left, this->batchSize())));
  }
}

void Learner::learnBatch(std::size_t size)
{
  this->mesh_.releaseErased();
  const std::span<const Vector4> samples = this->samples_.draw(size);
  this->prepareNoiseFilter(size);
  this->findWinners(samples);
  for (std::size_t i = 0; i < samples.size() && !this->hasAllVertices(); ++i)
  {
    this->prefetchAhead(i);
    if (!this->mesh_.isAlive(this->winners_[i]))
    {
      this->winners_[i] = this->grid_.closest(samples[i], this->mesh_.positions());
    }
    this->basicStep(samples[i], this->winners_[i]);
    ++this->counts_.iterations;
    if (this->isAdditionDue())
    {
      this->nodeAddition();
    }
    if (this->isRemovalDue())
    {
      this->nodeRemoval();
    }
    if (this->isTopologyDue())
    {
      this->learnTopology();
    }
  }
  if (this->mesh_.vertexCount() >= this->nextRenumbering_)
  {
    this->renumber();
  }
}

std::size_t Learner::batchSize() const
{
  return std::clamp<std::size_t>(this->mesh_.vertexCount() / VerticesPerSampleOfBatch, 1,
    std::size_t(this->parameters_.batchSize));
}

void Learner::findWinners(std::span<const Vector4> samples)
{
  this->winners_.resize(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (i + PrefetchDistance < samples.size())
    {
      this->grid_.prefetch(samples[i + PrefetchDistance]);
    }
    this->winners_[i] = this->grid_.closest(samples[i], this->mesh_.positions());
  }
}

void Learner::prefetchAhead(std::size_t sample) const
{
  if (sample + PrefetchDistance >= this->winners_.size())
  {
    return;
  }
  const Vector4* positions = this->mesh_.positions().data();
  const auto winnerIn = [&](std::size_t samples) { return this->winners_[sample + samples]; };
  __builtin_prefetch(&this->mesh_.ring(winnerIn(PrefetchDistance)));
  this->order_->prefetch(winnerIn(PrefetchDistance / 2));
  for (const VertexIndex neighbor : this->mesh_.ring(winnerIn(PrefetchDistance / 2)))
  {
    __builtin_prefetch(&this->mesh_.ring(neighbor));
    __builtin_prefetch(positions + neighbor);
  }
  if (this->mesh_.vertexCount() > VerticesInCache)
  {
    // Smoothing looks at the neighbours of the neighbours: two of each stand for those beside them.
    for (const VertexIndex neighbor : this->mesh_.ring(winnerIn(PrefetchDistance / 4)))
    {
      const Ring& ring = this->mesh_.ring(neighbor);
      __builtin_prefetch(positions + ring[0]);
      __builtin_prefetch(positions + ring[ring.size() / 2]);
    }
  }
}

// --- Geometry learning ---------------------------------------------------------------------------

void Learner::prepareNoiseFilter(std::size_t batchSize)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  this->observationStride_ = 1 + batchSize / ObservationsPerBatch;
  this->filterThreshold_ = infinity;
  this->observationLimit_ = infinity;
  this->rejectionLimit_ = infinity;
  if (this->parameters_.variant == Variant::NoiseFiltering && this->sampleDistances_.isFull())
  {
    this->filterThreshold_ = float(this->sampleDistances_.mean() +
      this->parameters_.noiseTolerance * this->sampleDistances_.deviation());
    if (this->parameters_.outlierLimit > 0. &&
      this->mesh_.vertexCount() >= std::size_t(this->parameters_.outlierLimitVertices))
    {
      this->observationLimit_ = ObservationLimit * this->filterThreshold_;
      this->rejectionLimit_ = float(this->parameters_.outlierLimit) * this->filterThreshold_;
    }
  }
}

void Learner::observeFirstMesh()
{
  const std::size_t count =
    std::min(std::size_t(this->parameters_.noiseWindow), MostFirstSamples / FirstObservations);
  for (int i = 0; i < FirstObservations; ++i)
  {
    const std::span<const Vector4> samples = this->samples_.draw(count);
    this->prepareNoiseFilter(count);
    this->findWinners(samples);
    for (std::size_t sample = 0; sample < count; ++sample)
    {
      const Vector4 winner = this->mesh_.position(this->winners_[sample]);
      this->observe(squaredNorm(samples[sample] - winner));
    }
  }
}

void Learner::observe(float squaredDistance)
{
  this->sampleDistances_.add(std::min(std::sqrt(squaredDistance), this->observationLimit_));
}

void Learner::basicStep(Vector4 sample, VertexIndex winner)
{
  const Vector4 toSample = sample - this->mesh_.position(winner);
  const float squaredDistance = squaredNorm(toSample);
  if (this->untilObservation_-- == 0)
  {
    this->untilObservation_ = this->observationStride_ - 1;
    this->observe(squaredDistance);
  }
  if (squaredDistance > this->rejectionLimit_ * this->rejectionLimit_)
  {
    ++this->counts_.rejectedSamples;
    this->order_->pass(this->decay_);
    return;
  }
  float rate = float(this->parameters_.winnerRate);
  if (squaredDistance > this->filterThreshold_ * this->filterThreshold_)
  {
    rate *= this->filterThreshold_ / std::sqrt(squaredDistance);
  }
  this->moveVertex(winner, this->mesh_.position(winner) + rate * toSample);
  for (int i = 0; i < this->parameters_.smoothingIterations; ++i)
  {
    this->smoothNeighbors(winner);
  }
  this->order_->win(winner, 1., this->decay_);
  if (this->parameters_.variant == Variant::Basic)
  {
    this->hasWon_[winner] = 1;
  }
}

void Learner::smoothNeighbors(VertexIndex winner)
{
  // All at once: first where all of them go, then the moves.
  const Ring& ring = this->mesh_.ring(winner);
  const auto rate = float(this->parameters_.smoothingRate);
  auto& positions = this->smoothedPositions_;
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    positions[slot] = smoothedPosition(this->mesh_, ring[slot], rate, this->boundarySmoothing_);
  }
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    this->moveVertex(ring[slot], positions[slot]);
  }
}

// --- Growth --------------------------------------------------------------------------------------

double Learner::patience() const
{
  const bool early = this->mesh_.vertexCount() < std::size_t(this->parameters_.earlyVertices);
  return early ? this->parameters_.earlyPatience : 1.;
}

bool Learner::isAdditionDue() const { return this->counts_.iterations >= this->nextAddition_; }

void Learner::nodeAddition()
{
  this->nextAddition_ += std::max<std::uint64_t>(
    1, std::uint64_t(this->patience() * this->parameters_.samplesPerAddition));

  for (int attempt = 0; attempt < SplitAttempts; ++attempt)
  {
    const VertexIndex v = this->order_->top();
    const auto plan = planVertexSplit(this->mesh_, v);
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
    if (this->parameters_.variant == Variant::Basic)
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

bool Learner::isRemovalDue() const
{
  return (this->parameters_.variant == Variant::Basic
             ? this->counts_.iterations
             : this->counts_.additions) >= this->nextRemoval_;
}

std::uint64_t Learner::removalInterval() const
{
  // Growth depends on the ratio of C_ec to C_vs, (6.18): patience is with both.
  return this->parameters_.variant == Variant::Basic
    ? std::uint64_t(
        this->patience() * this->parameters_.removalPatience * double(this->mesh_.vertexCount()))
    : std::uint64_t(this->parameters_.additionsPerRemoval);
}

void Learner::nodeRemoval()
{
  if (this->parameters_.variant == Variant::Basic)
  {
    this->removeIdleVertices();
  }
  else
  {
    this->removeVertices();
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
  this->mesh_.collapse(v, kept);
  this->grid_.erase(v, this->mesh_.position(v));
  this->order_->erase(v);
  if (this->parameters_.edgeFlips)
  {
    this->counts_.flips += flipEdgesAround(this->mesh_, kept);
  }
  ++this->counts_.removals;
  return true;
}

// --- Topology learning ---------------------------------------------------------------------------

bool Learner::isTopologyDue() const { return this->counts_.iterations >= this->nextTopology_; }

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
  this->isListDue_ = false;
  std::vector<VertexIndex> laziestFirst(this->mesh_.vertexCount());
  for (VertexIndex& v : laziestFirst)
  {
    v = this->order_->bottom();
    this->order_->erase(v);
  }
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

// --- Memory --------------------------------------------------------------------------------------

void Learner::renumber()
{
  std::vector<VertexIndex> alive;
  std::vector<Vector4> positions;
  alive.reserve(this->mesh_.vertexCount());
  positions.reserve(this->mesh_.vertexCount());
  for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
  {
    if (this->mesh_.isAlive(v))
    {
      alive.push_back(v);
      positions.push_back(this->mesh_.position(v));
    }
  }
  std::vector<VertexIndex> order = mortonOrder(positions, this->boxMin_, this->boxMax_);
  std::vector<std::uint8_t> hasWon(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = alive[order[i]];
    hasWon[i] = this->hasWon_.size() > order[i] ? this->hasWon_[order[i]] : 0;
  }
  this->hasWon_ = std::move(hasWon);
  this->mesh_.renumber(order);
  this->order_->renumber(order);
  if (this->topology_)
  {
    this->topology_->boundaries().renumber(order);
  }

  this->capacity_ = 64 + std::size_t(GrowthUntilRenumbering * 1.1 * double(order.size()));
  this->nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * double(order.size()));
  this->mesh_.reserve(this->capacity_);
  this->order_->reserve(this->capacity_);
  this->hasWon_.reserve(this->capacity_);
  this->grid_.reset(
    this->boxMin_, this->boxMax_, EdgesPerCell * meanEdgeLength(this->mesh_), this->capacity_);
  for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
  {
    this->grid_.insert(v, this->mesh_.position(v));
  }
}
}
