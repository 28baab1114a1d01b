// SPDX-License-Identifier: BSD-3-Clause
#include "learn/Learner.h"

#include "base/Archive.h"
#include "base/Morton.h"
#include "learn/ExactOrder.h"
#include "mesh/Smoothing.h"

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
  isListDue_ = parameters.order == Order::List;
}

Learner::Learner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh,
  std::span<const float> weights, const Executor& executor)
  : Learner(cloud, parameters, mesh, orderAfterOneWin(mesh.indexEnd()), executor)
{
  if (!weights.empty())
  {
    samples_ = SampleStream(cloud.points(), parameters.seed, weights);
  }
  isListDue_ = parameters.order == Order::List;
  enterListIfDue();
  observeFirstMesh();
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
    featureStrength_.emplace(mesh_.indexEnd(), parameters.featureMemory);
    samplesAfterGrowth_ = std::uint64_t(parameters.featureSamples *
      double(std::max<std::uint64_t>(parameters.numberOfVertices, mesh_.vertexCount())));
  }
  renumber();
  nextAddition_ = std::uint64_t(parameters_.samplesPerAddition);
  nextRemoval_ = removalInterval();
  if (parameters_.topologyLearning)
  {
    topology_.emplace(mesh_, parameters_);
    boundarySmoothing_ = parameters.topologyRules == TopologyRules::Thesis
      ? BoundarySmoothing::Everywhere
      : BoundarySmoothing::Along;
    nextTopology_ = topologyInterval();
  }
  updateDecay();
}

void Learner::learn(std::uint64_t sampleCount, const std::function<void()>& afterBatch)
{
  const std::uint64_t end = counts_.iterations + sampleCount;
  while (counts_.iterations < end && !isComplete())
  {
    const std::uint64_t left = end - counts_.iterations;
    learnBatch(std::size_t(std::min<std::uint64_t>(left, batchSize())));
    if (afterBatch)
    {
      afterBatch();
    }
  }
}

void Learner::learnBatch(std::size_t size)
{
  const bool isGrowing = !hasAllVertices();
  if (!isGrowing && !wanders_)
  {
    size = std::size_t(std::min<std::uint64_t>(size, samplesAfterGrowth_));
    samplesAfterGrowth_ -= size;
  }
  mesh_.releaseErased();
  const std::span<const Vector4> samples = samples_.draw(size, executor_);
  prepareNoiseFilter(size);
  winGain_.beginBatch(observationStride_);
  findWinners(samples);
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    prefetchAhead(i);
    if (!mesh_.isAlive(winners_[i]))
    {
      winners_[i] = grid_.closest(samples[i], mesh_.positions());
    }
    basicStep(samples[i], winners_[i]);
    ++counts_.iterations;
    if (isGrowing && isGrowthDue())
    {
      grow();
      if (hasAllVertices())
      {
        break;
      }
    }
    else if (!isGrowing && wanders_ && isAdditionDue())
    {
      wander();
    }
  }
  if (mesh_.vertexCount() >= nextRenumbering_)
  {
    tidy();
  }
}

void Learner::tidy()
{
  const auto count = double(mesh_.vertexCount());
  if (count <= LastRenumbering * double(parameters_.numberOfVertices))
  {
    renumber();
    return;
  }
  nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * count);
  makeGrid();
}

void Learner::changeCloud(
  const PointCloud& from, const PointCloud& to, const Parameters& parameters)
{
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    if (mesh_.isAlive(v))
    {
      mesh_.setPosition(v, to.fromInput(from.toInput(mesh_.position(v))));
    }
  }
  parameters_.numberOfVertices = parameters.numberOfVertices;
  samples_ = SampleStream(to.points(), parameters.seed, to.weights());
  boxMin_ = to.bulkMin();
  boxMax_ = to.bulkMax();
  mesh_.releaseErased();
  renumber();
}

std::size_t Learner::batchSize() const
{
  return std::clamp<std::size_t>(
    mesh_.vertexCount() / VerticesPerSampleOfBatch, 1, std::size_t(parameters_.batchSize));
}

void Learner::findWinners(std::span<const Vector4> samples)
{
  winners_.resize(samples.size());
  grid_.closest(samples, mesh_.positions(), winners_, executor_);
}

void Learner::prefetchAhead(std::size_t sample) const
{
  if (mesh_.vertexCount() <= VerticesInNearCache || sample + PrefetchDistance >= winners_.size())
  {
    return;
  }
  const Vector4* positions = mesh_.positions().data();
  const auto winnerIn = [&](std::size_t samples) { return winners_[sample + samples]; };
  __builtin_prefetch(&mesh_.ring(winnerIn(PrefetchDistance)));
  order_->prefetch(winnerIn(PrefetchDistance / 2));
  for (const VertexIndex neighbor : mesh_.ring(winnerIn(PrefetchDistance / 2)))
  {
    __builtin_prefetch(&mesh_.ring(neighbor));
    __builtin_prefetch(positions + neighbor);
  }
  if (mesh_.vertexCount() > VerticesInCache)
  {
    // Smoothing looks at the neighbours of the neighbours: two of each stand for those beside them.
    for (const VertexIndex neighbor : mesh_.ring(winnerIn(PrefetchDistance / 4)))
    {
      const Ring& ring = mesh_.ring(neighbor);
      __builtin_prefetch(positions + ring[0]);
      __builtin_prefetch(positions + ring[ring.size() / 2]);
    }
  }
}

// --- Geometry learning ---------------------------------------------------------------------------

void Learner::prepareNoiseFilter(std::size_t batchSize)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  observationStride_ = 1 + batchSize / ObservationsPerBatch;
  filterThreshold_ = infinity;
  observationLimit_ = infinity;
  squaredRejectionLimit_ = infinity;
  if (parameters_.filtersNoise() && sampleDistances_.isFull())
  {
    filterThreshold_ =
      float(sampleDistances_.mean() + parameters_.noiseTolerance * sampleDistances_.deviation());
    if (parameters_.outlierLimit > 0. &&
      mesh_.vertexCount() >= std::size_t(parameters_.outlierLimitVertices))
    {
      observationLimit_ = ObservationLimit * filterThreshold_;
      const float limit = float(parameters_.outlierLimit) * filterThreshold_;
      squaredRejectionLimit_ = limit * limit;
    }
  }
}

void Learner::observeFirstMesh()
{
  const std::size_t count =
    std::min(std::size_t(parameters_.noiseWindow), MostFirstSamples / FirstObservations);
  for (int i = 0; i < FirstObservations; ++i)
  {
    const std::span<const Vector4> samples = samples_.draw(count, executor_);
    prepareNoiseFilter(count);
    findWinners(samples);
    for (std::size_t sample = 0; sample < count; ++sample)
    {
      const Vector4 winner = mesh_.position(winners_[sample]);
      observe(squaredNorm(samples[sample] - winner));
    }
  }
}

void Learner::observe(float squaredDistance)
{
  sampleDistances_.add(std::min(std::sqrt(squaredDistance), observationLimit_));
}

void Learner::basicStep(Vector4 sample, VertexIndex winner)
{
  const Vector4 toSample = sample - mesh_.position(winner);
  const float squaredDistance = squaredNorm(toSample);
  if (untilObservation_-- == 0)
  {
    untilObservation_ = observationStride_ - 1;
    observe(squaredDistance);
  }
  if (squaredDistance > squaredRejectionLimit_)
  {
    ++counts_.rejectedSamples;
    order_->pass(decay_);
    return;
  }
  float rate = float(parameters_.winnerRate);
  if (squaredDistance > filterThreshold_ * filterThreshold_)
  {
    rate *= filterThreshold_ / std::sqrt(squaredDistance);
  }
  const Vector4 moved = mesh_.position(winner) + rate * toSample;
  double gain = 1.;
  if (winGain_.isDue(counts_.iterations)) [[unlikely]]
  {
    gain = measureMove(winner, moved);
  }
  moveVertex(winner, moved);
  for (int i = 0; i < parameters_.smoothingIterations; ++i)
  {
    smoothNeighbors(winner);
  }
  order_->win(winner, gain, decay_);
  if (!parameters_.filtersNoise())
  {
    hasWon_[winner] = 1;
  }
}

double Learner::measureMove(VertexIndex winner, Vector4 position)
{
  const double gain = winGain_.ofMove(mesh_, winner, position);
  if (featureStrength_)
  {
    featureStrength_->win(winner, winGain_.normalGain());
  }
  return gain;
}

void Learner::smoothNeighbors(VertexIndex winner)
{
  // All at once: first where all of them go, then the moves.
  const Ring& ring = mesh_.ring(winner);
  const auto rate = float(parameters_.smoothingRate);
  auto& positions = smoothedPositions_;
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    positions[slot] = smoothedPosition(mesh_, ring[slot], rate, boundarySmoothing_);
  }
  for (unsigned slot = 0; slot < ring.size(); ++slot)
  {
    moveVertex(ring[slot], positions[slot]);
  }
}

// --- Memory --------------------------------------------------------------------------------------

void Learner::renumber()
{
  const std::vector<VertexIndex> alive = vertices();
  std::vector<Vector4> positions;
  positions.reserve(alive.size());
  for (const VertexIndex v : alive)
  {
    positions.push_back(mesh_.position(v));
  }
  std::vector<VertexIndex> order = mortonOrder(positions, boxMin_, boxMax_, executor_);
  std::vector<std::uint8_t> hasWon(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = alive[order[i]];
    hasWon[i] = hasWon_.size() > order[i] ? hasWon_[order[i]] : 0;
  }
  hasWon_ = std::move(hasWon);
  mesh_.renumber(order);
  order_->renumber(order);
  if (topology_)
  {
    topology_->boundaries().renumber(order);
  }

  nextRenumbering_ = 1 + std::size_t(GrowthUntilRenumbering * double(order.size()));
  if (featureStrength_)
  {
    featureStrength_->renumber(order);
  }
  reserve();
  makeGrid();
}

std::vector<VertexIndex> Learner::vertices() const
{
  std::vector<VertexIndex> result;
  result.reserve(mesh_.vertexCount());
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    if (mesh_.isAlive(v))
    {
      result.push_back(v);
    }
  }
  return result;
}

/// Memory up to the next renumbering, and for what a batch may add beyond.
void Learner::reserve()
{
  const double all = RoomBeyondAll * double(parameters_.numberOfVertices);
  const double next = 1.1 * double(nextRenumbering_);
  const double most = std::max(all, double(mesh_.indexEnd()));
  capacity_ = 64 + std::size_t(std::min(next, most));
  mesh_.reserve(capacity_);
  order_->reserve(capacity_);
  hasWon_.reserve(capacity_);
  if (featureStrength_)
  {
    featureStrength_->reserve(capacity_);
  }
}

void Learner::makeGrid()
{
  grid_.reset(boxMin_, boxMax_, EdgesPerCell * float(mesh_.meanEdge()), capacity_);
  for (const VertexIndex v : vertices())
  {
    grid_.insert(v, mesh_.position(v));
  }
}

// --- The state as a whole ------------------------------------------------------------------------

void Learner::exchange(Archive& archive)
{
  archive(counts_, mesh_, samples_, sampleDistances_, winGain_);
  archive.require(mesh_.vertexCount() > 0);
  exchangeOrder(archive);
  if (topology_)
  {
    topology_->boundaries().exchange(archive, mesh_);
  }
  if (featureStrength_)
  {
    featureStrength_->exchange(archive, mesh_.indexEnd());
  }
  if (!parameters_.filtersNoise())
  {
    archive(hasWon_);
    archive.require(hasWon_.size() >= mesh_.indexEnd());
  }
  const std::uint64_t mostSamplesAfterGrowth = samplesAfterGrowth_;
  archive(untilObservation_, nextAddition_, nextRemoval_, nextTopology_);
  archive(samplesAfterGrowth_, nextRenumbering_);
  archive.require(samplesAfterGrowth_ <= mostSamplesAfterGrowth &&
    double(nextRenumbering_) <= 1. + GrowthUntilRenumbering * double(mesh_.indexEnd()));
  if (archive.isReading())
  {
    // What follows from the rest.
    updateDecay();
    reserve();
    makeGrid();
  }
}

void Learner::exchangeOrder(Archive& archive)
{
  bool isListDue = isListDue_;
  archive(isListDue);
  if (isListDue_ && !isListDue)
  {
    enterList({});
  }
  archive.require(isListDue_ == isListDue);
  order_->exchange(archive, vertices());
}
}
