// SPDX-License-Identifier: BSD-3-Clause
#include "Learner.h"

#include "Archive.h"
#include "ExactOrder.h"
#include "Morton.h"
#include "Smoothing.h"

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
/// Meshes up to this size stay in the nearer cache by themselves, more or less; up to that size in
/// the next one.
constexpr std::size_t VerticesInNearCache = 1 << 12;
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
/// Beyond this part of all vertices only the grid is made anew: the copies that renumbering takes
/// would be the most memory of the run.
constexpr double LastRenumbering = 0.7;
/// More than all vertices: those that a batch adds before the ones it removes are used again.
constexpr double RoomBeyondAll = 1.03;

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

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, const Executor& executor)
  : Learner(cloud, parameters, firstTetrahedron(cloud), std::make_unique<ExactOrder>(4), executor)
{
  this->isListDue_ = parameters.order == Order::List;
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh,
  std::span<const float> weights, const Executor& executor)
  : Learner(cloud, parameters, mesh, orderAfterOneWin(mesh.indexEnd()), executor)
{
  if (!weights.empty())
  {
    this->samples_ = SampleStream(cloud.points(), parameters.seed, weights);
  }
  this->isListDue_ = parameters.order == Order::List;
  this->enterListIfDue();
  this->observeFirstMesh();
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, Mesh mesh,
  std::unique_ptr<ActivityOrder> order, const Executor& executor)
  : parameters_(parameters)
  , executor_(executor)
  , mesh_(std::move(mesh))
  , order_(std::move(order))
  , samples_(cloud.points(), parameters.seed, cloud.weights())
  , sampleDistances_(std::size_t(parameters.noiseWindow))
  , boxMin_(cloud.bulkMin())
  , boxMax_(cloud.bulkMax())
  , hasWon_(mesh_.indexEnd(), 1)
  , winGain_(parameters)
{
  if (parameters.computeFeatureStrength)
  {
    this->featureStrength_.emplace(this->mesh_.indexEnd(), parameters.featureMemory);
    this->samplesAfterGrowth_ = std::uint64_t(parameters.featureSamples *
      double(std::max<std::uint64_t>(parameters.numberOfVertices, this->mesh_.vertexCount())));
  }
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

void Learner::learn(std::uint64_t sampleCount, const std::function<void()>& afterBatch)
{
  const std::uint64_t end = this->counts_.iterations + sampleCount;
  while (this->counts_.iterations < end && !this->isComplete())
  {
    const std::uint64_t left = end - this->counts_.iterations;
    this->learnBatch(std::size_t(std::min<std::uint64_t>(left, this->batchSize())));
    if (afterBatch)
    {
      afterBatch();
    }
  }
}

void Learner::learnBatch(std::size_t size)
{
  const bool isGrowing = !this->hasAllVertices();
  if (!isGrowing && !this->wanders_)
  {
    size = std::size_t(std::min<std::uint64_t>(size, this->samplesAfterGrowth_));
    this->samplesAfterGrowth_ -= size;
  }
  this->mesh_.releaseErased();
  const std::span<const Vector4> samples = this->samples_.draw(size, this->executor_);
  this->prepareNoiseFilter(size);
  this->winGain_.beginBatch(this->observationStride_);
  this->findWinners(samples);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    this->prefetchAhead(i);
    if (!this->mesh_.isAlive(this->winners_[i]))
    {
      this->winners_[i] = this->grid_.closest(samples[i], this->mesh_.positions());
    }
    this->basicStep(samples[i], this->winners_[i]);
    ++this->counts_.iterations;
    if (isGrowing && this->isGrowthDue())
    {
      this->grow();
      if (this->hasAllVertices())
      {
        break;
      }
    }
    else if (!isGrowing && this->wanders_ && this->isAdditionDue())
    {
      this->wander();
    }
  }
  if (this->mesh_.vertexCount() >= this->nextRenumbering_)
  {
    this->tidy();
  }
}

void Learner::tidy()
{
  const auto count = double(this->mesh_.vertexCount());
  if (count <= LastRenumbering * double(this->parameters_.numberOfVertices))
  {
    this->renumber();
    return;
  }
  this->nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * count);
  this->makeGrid();
}

void Learner::changeCloud(
  const PointCloud& from, const PointCloud& to, const Parameters& parameters)
{
  for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
  {
    if (this->mesh_.isAlive(v))
    {
      this->mesh_.setPosition(v, to.fromInput(from.toInput(this->mesh_.position(v))));
    }
  }
  this->parameters_.numberOfVertices = parameters.numberOfVertices;
  this->samples_ = SampleStream(to.points(), parameters.seed, to.weights());
  this->boxMin_ = to.bulkMin();
  this->boxMax_ = to.bulkMax();
  this->mesh_.releaseErased();
  this->renumber();
}

std::size_t Learner::batchSize() const
{
  return std::clamp<std::size_t>(this->mesh_.vertexCount() / VerticesPerSampleOfBatch, 1,
    std::size_t(this->parameters_.batchSize));
}

void Learner::findWinners(std::span<const Vector4> samples)
{
  this->winners_.resize(samples.size());
  this->grid_.closest(samples, this->mesh_.positions(), this->winners_, this->executor_);
}

void Learner::prefetchAhead(std::size_t sample) const
{
  if (this->mesh_.vertexCount() <= VerticesInNearCache ||
    sample + PrefetchDistance >= this->winners_.size())
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
  this->squaredRejectionLimit_ = infinity;
  if (this->parameters_.filtersNoise() && this->sampleDistances_.isFull())
  {
    this->filterThreshold_ = float(this->sampleDistances_.mean() +
      this->parameters_.noiseTolerance * this->sampleDistances_.deviation());
    if (this->parameters_.outlierLimit > 0. &&
      this->mesh_.vertexCount() >= std::size_t(this->parameters_.outlierLimitVertices))
    {
      this->observationLimit_ = ObservationLimit * this->filterThreshold_;
      const float limit = float(this->parameters_.outlierLimit) * this->filterThreshold_;
      this->squaredRejectionLimit_ = limit * limit;
    }
  }
}

void Learner::observeFirstMesh()
{
  const std::size_t count =
    std::min(std::size_t(this->parameters_.noiseWindow), MostFirstSamples / FirstObservations);
  for (int i = 0; i < FirstObservations; ++i)
  {
    const std::span<const Vector4> samples = this->samples_.draw(count, this->executor_);
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
  if (squaredDistance > this->squaredRejectionLimit_)
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
  const Vector4 moved = this->mesh_.position(winner) + rate * toSample;
  double gain = 1.;
  if (this->winGain_.isDue(this->counts_.iterations)) [[unlikely]]
  {
    gain = this->measureMove(winner, moved);
  }
  this->moveVertex(winner, moved);
  for (int i = 0; i < this->parameters_.smoothingIterations; ++i)
  {
    this->smoothNeighbors(winner);
  }
  this->order_->win(winner, gain, this->decay_);
  if (!this->parameters_.filtersNoise())
  {
    this->hasWon_[winner] = 1;
  }
}

double Learner::measureMove(VertexIndex winner, Vector4 position)
{
  const double gain = this->winGain_.ofMove(this->mesh_, winner, position);
  if (this->featureStrength_)
  {
    this->featureStrength_->win(winner, this->winGain_.normalGain());
  }
  return gain;
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

// --- Memory --------------------------------------------------------------------------------------

void Learner::renumber()
{
  const std::vector<VertexIndex> alive = this->vertices();
  std::vector<Vector4> positions;
  positions.reserve(alive.size());
  for (const VertexIndex v : alive)
  {
    positions.push_back(this->mesh_.position(v));
  }
  std::vector<VertexIndex> order =
    mortonOrder(positions, this->boxMin_, this->boxMax_, this->executor_);
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

  this->nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * double(order.size()));
  if (this->featureStrength_)
  {
    this->featureStrength_->renumber(order);
  }
  this->reserve();
  this->makeGrid();
}

std::vector<VertexIndex> Learner::vertices() const
{
  std::vector<VertexIndex> result;
  result.reserve(this->mesh_.vertexCount());
  for (VertexIndex v = 0; v < this->mesh_.indexEnd(); ++v)
  {
    if (this->mesh_.isAlive(v))
    {
      result.push_back(v);
    }
  }
  return result;
}

/// Memory up to the next renumbering, and for what a batch may add beyond.
void Learner::reserve()
{
  const double all = RoomBeyondAll * double(this->parameters_.numberOfVertices);
  const double next = 1.1 * double(this->nextRenumbering_);
  const double most = std::max(all, double(this->mesh_.indexEnd()));
  this->capacity_ = 64 + std::size_t(std::min(next, most));
  this->mesh_.reserve(this->capacity_);
  this->order_->reserve(this->capacity_);
  this->hasWon_.reserve(this->capacity_);
  if (this->featureStrength_)
  {
    this->featureStrength_->reserve(this->capacity_);
  }
}

void Learner::makeGrid()
{
  this->grid_.reset(
    this->boxMin_, this->boxMax_, EdgesPerCell * float(this->mesh_.meanEdge()), this->capacity_);
  for (const VertexIndex v : this->vertices())
  {
    this->grid_.insert(v, this->mesh_.position(v));
  }
}

// --- The state as a whole ------------------------------------------------------------------------

void Learner::exchange(Archive& archive)
{
  archive(this->counts_, this->mesh_, this->samples_, this->sampleDistances_, this->winGain_);
  archive.require(this->mesh_.vertexCount() > 0);
  this->exchangeOrder(archive);
  if (this->topology_)
  {
    this->topology_->boundaries().exchange(archive, this->mesh_);
  }
  if (this->featureStrength_)
  {
    this->featureStrength_->exchange(archive, this->mesh_.indexEnd());
  }
  if (!this->parameters_.filtersNoise())
  {
    archive(this->hasWon_);
    archive.require(this->hasWon_.size() >= this->mesh_.indexEnd());
  }
  const std::uint64_t mostSamplesAfterGrowth = this->samplesAfterGrowth_;
  archive(this->untilObservation_, this->nextAddition_, this->nextRemoval_, this->nextTopology_);
  archive(this->samplesAfterGrowth_, this->nextRenumbering_);
  archive.require(this->samplesAfterGrowth_ <= mostSamplesAfterGrowth &&
    double(this->nextRenumbering_) <= 1. + GrowthUntilRenumbering * double(this->mesh_.indexEnd()));
  if (archive.isReading())
  {
    // What follows from the rest.
    this->updateDecay();
    this->reserve();
    this->makeGrid();
  }
}

void Learner::exchangeOrder(Archive& archive)
{
  bool isListDue = this->isListDue_;
  archive(isListDue);
  if (this->isListDue_ && !isListDue)
  {
    this->enterList({});
  }
  archive.require(this->isListDue_ == isListDue);
  this->order_->exchange(archive, this->vertices());
}
}
