// SPDX-License-Identifier: BSD-3-Clause
#include "learn/SequentialLearner.h"

#include "base/Archive.h"
#include "base/Scattered.h"
#include "learn/ExactOrder.h"
#include "learn/OutlierDistance.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// A batch is so small a part of the mesh that hardly any vertex wins twice in it.
constexpr std::size_t VerticesPerSampleOfBatch = 8;

/// How often the window of the noise filter is filled before a first mesh is learnt, and with how
/// many samples at most: each time the limit sinks, until it tells outliers.
constexpr int FirstObservations = 8;
constexpr std::size_t MostFirstSamples = 1 << 16;

/// Of the counters of a first mesh: it tells those apart that have won equally often, and no others.
constexpr double LargestDifference = 1e-6;
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
/// a large mesh would be removed at once. They differ a little: with ties, the first removals would take
/// vertices that are side by side, and with them a corner of the surface.
std::unique_ptr<ActivityOrder> orderAfterOneWin(std::size_t count)
{
  auto order = std::make_unique<ExactOrder>(count);
  for (VertexIndex v = 0; v < count; ++v)
  {
    order->win(v, 1. + LargestDifference * 0x1p-32 * double(scattered(v)), 1.);
  }
  return order;
}
}

SequentialLearner::SequentialLearner(
  const PointCloud& cloud, const Parameters& parameters, const Executor& executor)
  : SequentialLearner(
      cloud, parameters, firstTetrahedron(cloud), std::make_unique<ExactOrder>(4), executor)
{
  isListDue_ = parameters.order == Order::List;
}

SequentialLearner::SequentialLearner(const PointCloud& cloud, const Parameters& parameters,
  const Mesh& mesh, std::span<const float> weights, const Executor& executor)
  : SequentialLearner(cloud, parameters, mesh, orderAfterOneWin(mesh.indexEnd()), executor)
{
  if (!weights.empty())
  {
    samples_ = SampleStream(cloud.points(), parameters.seed, weights);
  }
  isListDue_ = parameters.order == Order::List;
  enterListIfDue();
  thinParts_.find(neuralMesh_, executor_);
  observeFirstMesh();
}

SequentialLearner::SequentialLearner(const PointCloud& cloud, const Parameters& parameters,
  Mesh mesh, std::unique_ptr<ActivityOrder> order, const Executor& executor)
  : Learner(parameters, executor)
  , neuralMesh_(std::move(mesh), std::move(order), cloud.bulkMin(), cloud.bulkMax(),
      std::size_t(parameters.numberOfVertices), executor_)
  , samples_(cloud.points(), parameters.seed, cloud.weights())
  , thinParts_(neuralMesh_)
{
  if (!parameters.filtersNoise())
  {
    hasWon_ = neuralMesh_.addProperty(std::uint8_t(1), OnSplit::Begin);
  }
  if (parameters.computeFeatureStrength)
  {
    featureStrength_.emplace(neuralMesh_, parameters.featureMemory);
    samplesAfterGrowth_ = std::uint64_t(parameters.featureSamples *
      double(std::max<std::uint64_t>(parameters.numberOfVertices, neuralMesh_.vertexCount())));
  }
  nextRemoval_ = removalInterval();
  if (parameters_.topologyLearning)
  {
    neuralMesh_.traceBoundaries();
    topology_.emplace(parameters_);
    boundarySmoothing_ = parameters.topologyRules == TopologyRules::Thesis
      ? BoundarySmoothing::Everywhere
      : BoundarySmoothing::Along;
    nextTopology_ = topologyInterval();
  }
  updateDecay();
}

std::size_t SequentialLearner::batchSize() const
{
  return std::clamp<std::size_t>(
    neuralMesh_.vertexCount() / VerticesPerSampleOfBatch, 1, std::size_t(parameters_.batchSize));
}

void SequentialLearner::learnBatch(std::size_t size)
{
  const bool isGrowing = !hasAllVertices();
  if (!isGrowing && !wanders_)
  {
    size = std::size_t(std::min<std::uint64_t>(size, samplesAfterGrowth_));
    samplesAfterGrowth_ -= size;
  }
  neuralMesh_.releaseErased();
  const std::span<const Vector4> samples = samples_.draw(size, executor_);
  noiseFilter_.beginBatch(size, neuralMesh_.vertexCount());
  winGain_.beginBatch(noiseFilter_.observationStride());
  findWinners(samples);
  const bool hasThinParts = thinParts_.any();
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    neuralMesh_.prefetchBehind(i, winners_);
    if (!mesh().isAlive(winners_[i]))
    {
      winners_[i] = neuralMesh_.winner(samples[i]);
    }
    if (hasThinParts)
    {
      winners_[i] = thinParts_.facingWinner(neuralMesh_, samples[i], winners_[i]);
    }
    basicStep(samples[i], winners_[i]);
    ++counts_.iterations;
    if (isGrowing && isGrowthDue())
    {
      grow();
      if (hasAllVertices())
      {
        break; // the rest of the samples was drawn for growth
      }
    }
    else if (!isGrowing && wanders_ && isAdditionDue())
    {
      wander();
    }
  }
  neuralMesh_.compactIfGrown(executor_);
  if (hasThinParts)
  {
    thinParts_.lookIfGrown(neuralMesh_, executor_);
  }
}

void SequentialLearner::findWinners(std::span<const Vector4> samples)
{
  winners_.resize(samples.size());
  neuralMesh_.findWinners(samples, winners_, executor_);
}

void SequentialLearner::basicStep(Vector4 sample, VertexIndex winner)
{
  const Vector4 toSample = sample - mesh().position(winner); // d
  const float squaredDistance = squaredNorm(toSample);
  noiseFilter_.observeNowAndThen(squaredDistance);
  if (isOutlier(winner, squaredDistance))
  {
    ++counts_.rejectedSamples;
    neuralMesh_.pass(decay_);
    return;
  }
  // (6.1), or (9.1) with F(|d|) of (9.2)
  const float rate = float(parameters_.winnerRate) * noiseFilter_.pull(squaredDistance);
  const Vector4 moved = mesh().position(winner) + rate * toSample;
  const double gain = winGain_.isDue(counts_.iterations) ? gainOfMove(winner, moved) : 1.;
  neuralMesh_.move(winner, moved);
  // (6.2) to (6.4)
  for (int i = 0; i < parameters_.smoothingIterations; ++i)
  {
    neuralMesh_.smoothRing(winner, float(parameters_.smoothingRate), boundarySmoothing_);
  }
  // (6.5), (6.6); (8.3), (8.4); (9.5)
  neuralMesh_.win(winner, gain, decay_);
  if (hasWon_)
  {
    neuralMesh_.values(*hasWon_)[winner] = 1;
  }
}

bool SequentialLearner::isOutlier(VertexIndex winner, float squaredDistance) const
{
  return noiseFilter_.rejects(squaredDistance) && isFarOutside(mesh(), winner, squaredDistance);
}

double SequentialLearner::gainOfMove(VertexIndex winner, Vector4 position)
{
  const double gain = winGain_.ofMove(mesh(), winner, position);
  if (featureStrength_)
  {
    featureStrength_->win(neuralMesh_, winner, winGain_.normalGain());
  }
  return gain;
}

void SequentialLearner::observeFirstMesh()
{
  const std::size_t count =
    std::min(std::size_t(parameters_.noiseWindow), MostFirstSamples / FirstObservations);
  for (int i = 0; i < FirstObservations; ++i)
  {
    const std::span<const Vector4> samples = samples_.draw(count, executor_);
    noiseFilter_.beginBatch(count, neuralMesh_.vertexCount());
    findWinners(samples);
    for (std::size_t sample = 0; sample < count; ++sample)
    {
      noiseFilter_.observe(squaredNorm(samples[sample] - mesh().position(winners_[sample])));
    }
  }
}

void SequentialLearner::changeCloud(
  const PointCloud& from, const PointCloud& to, const Parameters& parameters)
{
  parameters_.numberOfVertices = parameters.numberOfVertices;
  samples_ = SampleStream(to.points(), parameters.seed, to.weights());
  neuralMesh_.setMostVertices(std::size_t(parameters.numberOfVertices));
  neuralMesh_.moveAll(to.bulkMin(), to.bulkMax(),
    [&](Vector4 position) { return to.fromInput(from.toInput(position)); });
  neuralMesh_.releaseErased();
  compact();
}

LearntMesh SequentialLearner::learntMesh() const
{
  LearntMesh result{ mesh(), {}, {} };
  result.activity = result.mesh.addProperty(0., OnSplit::Copy);
  const std::span<double> activities = result.mesh.values(result.activity);
  for (const VertexIndex v : neuralMesh_.vertices())
  {
    activities[v] = order().activity(v);
  }
  if (featureStrength_)
  {
    result.featureStrength = featureStrength_->property();
  }
  result.mesh.dropErased();
  return result;
}

// --- The state as a whole ------------------------------------------------------------------------

void SequentialLearner::exchange(Archive& archive)
{
  bool isListDue = isListDue_;
  archive(isListDue);
  if (isListDue_ && !isListDue)
  {
    enterList();
  }
  archive.require(isListDue_ == isListDue);
  archive(counts_, neuralMesh_, samples_, noiseFilter_, winGain_);
  const std::uint64_t mostSamplesAfterGrowth = samplesAfterGrowth_;
  archive(nextAddition_, nextRemoval_, nextTopology_, samplesAfterGrowth_);
  archive.require(samplesAfterGrowth_ <= mostSamplesAfterGrowth);
  thinParts_.exchange(archive);
  if (archive.isReading())
  {
    updateDecay();
  }
}
}
