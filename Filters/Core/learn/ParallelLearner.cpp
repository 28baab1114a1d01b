// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ParallelLearner.h"

#include "base/Archive.h"
#include "base/InterruptibleExecutor.h"
#include "cloud/OppositeLayer.h"
#include "learn/OutlierDistance.h"
#include "mesh/MortonPermutation.h"
#include "mesh/SelfIntersections.h"
#include "mesh/Smoothing.h"
#include "mesh/Subdivision.h"
#include "mesh/TriangleShape.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
/// A part for the executor.
constexpr std::size_t VerticesOfPart = 2048;
constexpr std::size_t SamplesPerPart = 1024;

/// Smaller meshes are learnt in a moment, one sample after the other.
constexpr std::uint64_t LeastVerticesAtOnce = 100000;
/// A batch is that part of the mesh: so a vertex wins once in two batches, on average.
constexpr double PartOfBatch = 0.5;
/// Samples until there are all vertices, against those that would be due: some splits are not legal.
constexpr double SamplesUntilEnd = 1.12;

/// Of the vertices, how many a mesh has before each of its triangles is made four.
constexpr double PartOfCoarse = 0.9 / 4.;
/// ... if at most so many of the edges bend by more than 60 degrees.
constexpr double MostSharpIfResolved = 0.001;
constexpr float CosineOfSharpBend = 0.5f;

constexpr std::uint32_t NoWin = 0xffffffffu;
/// How far ahead what samples need is brought into the cache.
constexpr std::size_t CellsAhead = 12;
constexpr std::size_t VerticesAhead = 6;

constexpr float GridEdgesPerCell = 2.f;
/// Where more crowd, as most points are in one place, a grid that divides its cells is faster.
constexpr std::size_t MostInPackedCell = 400;
/// The mean edge is that of so many vertices.
constexpr std::size_t VerticesOfMeanEdge = 512;
/// Vertices are renumbered whenever there are so many times more.
constexpr double GrowthUntilTidy = 1.4;
/// Thin parts are looked at whenever there are so many times more.
constexpr double GrowthUntilThinLook = 1.5;

/// Of the samples of a batch, those whose moves are measured for the learning curve.
constexpr std::size_t ObservationsPerMove = 4;
/// How often the window of the noise filter is filled before a first mesh is learnt, and with how many samples at most.
constexpr int FirstWindows = 8;
constexpr std::size_t MostFirstObservations = 1 << 16;
}

bool ParallelLearner::isFor(const Parameters& parameters)
{
  return parameters.numberOfVertices >= LeastVerticesAtOnce &&
    parameters.batchSize >= Parameters().batchSize && parameters.filtersNoise() &&
    parameters.order == Order::Exact && !parameters.topologyLearning &&
    !parameters.computeFeatureStrength && parameters.edgeFlips &&
    parameters.smoothingIterations == 1 &&
    parameters.additionOperation == AdditionOperation::VertexSplit &&
    parameters.removalOperation == RemovalOperation::HalfEdgeCollapse;
}

ParallelLearner::ParallelLearner(const PointCloud& cloud, const Parameters& parameters,
  const Mesh& mesh, std::span<const float> weights, const Executor& executor)
  : Learner(parameters, executor)
  , mesh_(mesh)
  , boxMin_(cloud.bulkMin())
  , boxMax_(cloud.bulkMax())
  , samples_(cloud.points(), parameters.seed, weights.empty() ? cloud.weights() : weights)
{
  mesh_.dropProperties();
  activity_ = mesh_.addProperty(1.f, OnSplit::Copy);
  isThin_ = mesh_.addProperty(std::uint8_t(1), OnSplit::Copy);
  for (std::size_t wins = 0; wins < rates_.size(); ++wins)
  {
    rates_[wins] = float(1. - std::pow(1. - parameters.smoothingRate, double(wins)));
  }
  samplesAfterGrowth_ =
    std::uint64_t(PartOfBatch * double(std::max<std::uint64_t>(parameters.numberOfVertices, 2)));
  isCoarse_ = mesh_.vertexCount() < std::size_t(PartOfCoarse * double(parameters.numberOfVertices));
  nextRemoval_ = removalInterval();
  updateDecay();
  tidy();
  makeGrid();
  lookForThinParts();
  observeFirstMesh();
}

std::size_t ParallelLearner::batchSize() const
{
  const auto count = double(mesh_.vertexCount());
  const double left = double(verticesOfStage()) - count;
  const double needed =
    left > 0. ? 1. + SamplesUntilEnd * left * patience() * parameters_.samplesPerAddition : count;
  return std::size_t(std::max(1., std::min(PartOfBatch * count, needed)));
}

/// Algorithm 4, with all of its samples at once.
void ParallelLearner::learnBatch(std::size_t size)
{
  const bool isGrowing = !hasAllVertices();
  if (!isGrowing && !wanders_)
  {
    size = std::size_t(std::min<std::uint64_t>(size, samplesAfterGrowth_));
    samplesAfterGrowth_ -= size;
  }
  mesh_.releaseErased();
  noiseFilter_.beginBatch(size, mesh_.vertexCount());
  findWinners(size);
  takeSamples();
  observe();
  smooth();
  counts_.iterations += size;
  if (isGrowing || wanders_)
  {
    grow();
  }
}

void ParallelLearner::endBatch()
{
  if (isCoarse_ && mesh_.vertexCount() >= verticesOfStage())
  {
    if (isResolved())
    {
      subdivideAll();
    }
    isCoarse_ = false;
  }
  tidyIfGrown();
}

/// v_w of all samples: each vertex gets the list of those that it has won.
void ParallelLearner::findWinners(std::size_t size)
{
  makeGrid();
  samples_.beginBatch(size);
  batch_.resize(size);
  nextWon_.resize(size);
  firstWon_.resize(mesh_.indexEnd());
  executor_.forEachRange(firstWon_.size(), VerticesOfPart,
    [this](std::size_t begin, std::size_t end)
    {
      std::fill(
        firstWon_.begin() + std::ptrdiff_t(begin), firstWon_.begin() + std::ptrdiff_t(end), NoWin);
    });
  const std::size_t stride = noiseFilter_.observationStride();
  observed_.resize((size + stride - 1) / stride);
  observedDistances_.resize(observed_.size());
  executor_.forEachRange(size, SamplesPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      Random random = samples_.from(begin);
      for (std::size_t i = begin; i < end; ++i)
      {
        batch_[i] = samples_.draw(i, random);
      }
      for (std::size_t i = begin; i < end; ++i)
      {
        grid_.prefetchCell(batch_[std::min(i + CellsAhead, end - 1)]);
        grid_.prefetchVertices(batch_[std::min(i + VerticesAhead, end - 1)]);
        const Vector4 sample = batch_[i];
        VertexIndex winner = closestTo(sample);
        winner = hasThinParts_ ? facingWinner(sample, winner) : winner;
        nextWon_[i] =
          std::atomic_ref(firstWon_[winner]).exchange(std::uint32_t(i), std::memory_order_relaxed);
        if (i % stride == 0)
        {
          observed_[i / stride] = winner;
          observedDistances_[i / stride] = squaredNorm(sample - mesh_.position(winner));
        }
      }
    });
}

/// (9.1) with F(|d|) of (9.2), one after the other at each winner; and (9.5), in which all activities have decayed by
/// the whole batch.
void ParallelLearner::takeSamples()
{
  const std::size_t count = mesh_.indexEnd();
  moved_.resize(count);
  wins_.resize(count);
  const std::span<float> activity = mesh_.values(activity_);
  const auto decay = float(std::pow(decay_, double(batch_.size())));
  const auto winnerRate = float(parameters_.winnerRate);
  std::atomic<std::uint64_t> rejected = 0;
  executor_.forEachRange(count, VerticesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::uint32_t> won;
      std::uint64_t rejectedHere = 0;
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        Vector4 position = mesh_.position(v);
        unsigned wins = 0;
        won.clear();
        for (std::uint32_t i = firstWon_[v]; i != NoWin; i = nextWon_[i])
        {
          won.push_back(i);
        }
        // They have come in any order.
        std::sort(won.begin(), won.end());
        for (const std::uint32_t i : won)
        {
          const Vector4 toSample = batch_[i] - position; // d
          const float squaredDistance = squaredNorm(toSample);
          if (noiseFilter_.rejects(squaredDistance) && isFarOutside(mesh_, v, squaredDistance))
          {
            ++rejectedHere;
            continue;
          }
          position += (winnerRate * noiseFilter_.pull(squaredDistance)) * toSample;
          ++wins;
        }
        moved_[v] = position;
        wins_[v] = std::uint8_t(std::min(wins, 255u));
        activity[v] = activity[v] * decay + float(wins);
      }
      rejected += rejectedHere;
    });
  counts_.rejectedSamples += rejected;
}

/// What the noise filter and the learning curve want to know.
void ParallelLearner::observe()
{
  winGain_.beginBatch(1);
  for (std::size_t i = 0; i < observed_.size(); ++i)
  {
    noiseFilter_.observe(observedDistances_[i]);
    if (i % ObservationsPerMove == 0)
    {
      winGain_.ofMove(mesh_, observed_[i], moved_[observed_[i]]);
    }
  }
}

/// (6.2) to (6.4), once for as many wins as there were around each vertex: a rate of 1 - (1 - alpha_L)^wins.
void ParallelLearner::smooth()
{
  executor_.forEachRange(mesh_.indexEnd(), VerticesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const Ring& ring = mesh_.ring(v);
        std::size_t wins = 0;
        for (const VertexIndex neighbor : ring)
        {
          wins += wins_[neighbor];
        }
        const float rate = rates_[std::min(wins, rates_.size() - 1)];
        Vector4 position = moved_[v];
        if (wins > 0)
        {
          position = ring.isOpen()
            ? smoothedAlongBoundary(moved_.data(), position, ring, rate)
            : smoothedInTangentPlane(moved_.data(), position, ring, ring.back(), rate);
        }
        mesh_.setPosition(v, position);
      }
    });
}

std::size_t ParallelLearner::verticesOfStage() const
{
  const auto count = std::size_t(parameters_.numberOfVertices);
  return isCoarse_ ? std::size_t(PartOfCoarse * double(count)) : count;
}

/// Whether hardly any edge bends sharply: where the surface has narrow parts or creases, or follows noise, growth finds
/// places for vertices that are not in the middle of edges.
bool ParallelLearner::isResolved() const
{
  const auto countWhere = [this](const auto& isCounted)
  {
    return interruptible_.sum(mesh_.indexEnd(), VerticesOfPart,
      [&](std::size_t v)
      {
        double count = 0.;
        for (const VertexIndex other : mesh_.ring(VertexIndex(v)))
        {
          const bool isOnce = v < other && !mesh_.isBoundaryEdge(VertexIndex(v), other);
          count += isOnce && isCounted(VertexIndex(v), other) ? 1. : 0.;
        }
        return count;
      });
  };
  const auto isSharp = [this](VertexIndex a, VertexIndex b)
  {
    const auto opposite = oppositeTo(mesh_, { a, b });
    const Vector4 from = mesh_.position(a), edge = mesh_.position(b) - from;
    return cosineBetween(cross(edge, mesh_.position(opposite[0]) - from),
             cross(mesh_.position(opposite[1]) - from, edge)) < CosineOfSharpBend;
  };
  const double edges = countWhere([](VertexIndex, VertexIndex) { return true; });
  return countWhere(isSharp) <= MostSharpIfResolved * edges;
}

/// Unit normals of all vertices; 0 where there is none.
std::vector<Vector4> ParallelLearner::normals() const
{
  std::vector<Vector4> result(mesh_.indexEnd());
  interruptible_.forEachRange(result.size(), VerticesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const Vector4 normal = mesh_.normal(v);
        const float length = std::sqrt(squaredNorm(normal));
        result[v] = length > 0.f ? 1.f / length * normal : Vector4();
      }
    });
  return result;
}

/// The middle of an edge is that of the cubic curve which is perpendicular to the normals at its ends (curved PN
/// triangles; Vlachos, Peters, Boyd and Mitchell 2001): that of a chord lies inside of what is round.
/// A vertex keeps a quarter of its activity; one in the middle of an edge gets an eighth of that of both ends.
/// The learner changes when all is made: an interruption leaves it as it was, but for the order of its vertices.
void ParallelLearner::subdivideAll()
{
  sortAlongCurve(mesh_, interruptible_);
  noteCompact();
  const auto valuesOf = [this](auto property)
  {
    const auto values = std::as_const(mesh_).values(property);
    return std::vector(values.begin(), values.end());
  };
  const std::vector<float> activityBefore = valuesOf(activity_);
  const std::vector<std::uint8_t> isThinBefore = valuesOf(isThin_);
  const std::vector<Vector4> normal = normals();
  auto [mesh, edges] = subdivide(mesh_, interruptible_);
  const auto activityAfter = mesh.addProperty(1.f, OnSplit::Copy);
  const auto isThinAfter = mesh.addProperty(std::uint8_t(1), OnSplit::Copy);
  const std::span<float> activity = mesh.values(activityAfter);
  const std::span<std::uint8_t> isThin = mesh.values(isThinAfter);
  const std::size_t count = activityBefore.size();
  interruptible_.forEachRange(count, VerticesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t v = begin; v < end; ++v)
      {
        activity[v] = 0.25f * activityBefore[v];
        isThin[v] = isThinBefore[v];
      }
    });
  interruptible_.forEachRange(edges.size(), VerticesOfPart,
    [&, &mesh = mesh, &edges = edges](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const auto& [a, b] = edges[i];
        const auto middle = VertexIndex(count + i);
        const Vector4 edge = mesh.position(b) - mesh.position(a);
        mesh.setPosition(middle,
          mesh.position(middle) +
            0.125f * (dot(edge, normal[b]) * normal[b] - dot(edge, normal[a]) * normal[a]));
        activity[middle] = 0.125f * (activityBefore[a] + activityBefore[b]);
        isThin[middle] = isThinBefore[a] | isThinBefore[b];
      }
    });
  sortAlongCurve(mesh, interruptible_);
  mesh_ = std::move(mesh);
  activity_ = activityAfter;
  isThin_ = isThinAfter;
  noteCompact();
  counts_.additions += edges.size();
  nextRemoval_ = counts_.additions + removalInterval();
  updateDecay();
}

VertexIndex ParallelLearner::facingWinner(Vector4 sample, VertexIndex closest) const
{
  return mesh_.values(isThin_)[closest] == 0
    ? closest
    : neuralmesh::facingWinner(
        sample, mesh_, closest, [this](Vector4 point) { return closestTo(point); });
}

/// Takes the distances to a first mesh before it moves: outliers would pull at it at once.
void ParallelLearner::observeFirstMesh()
{
  const std::size_t count =
    std::min(std::size_t(parameters_.noiseWindow), MostFirstObservations / FirstWindows);
  for (int window = 0; window < FirstWindows; ++window)
  {
    samples_.beginBatch(count);
    noiseFilter_.beginBatch(count, mesh_.vertexCount());
    Random random = samples_.from(0);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Vector4 sample = samples_.draw(i, random);
      noiseFilter_.observe(squaredNorm(sample - mesh_.position(closestTo(sample))));
    }
  }
}

void ParallelLearner::lookForThinParts()
{
  const std::span<std::uint8_t> isThin = mesh_.values(isThin_);
  const std::vector<VertexIndex> opposite = oppositeVertices(
    mesh_, [this](Vector4 point) { return closestTo(point); }, isThin, executor_);
  std::transform(opposite.begin(), opposite.end(), isThin.begin(),
    [](VertexIndex v) { return std::uint8_t(v == NoVertex ? 0 : 1); });
  hasThinParts_ = std::find(isThin.begin(), isThin.end(), 1) != isThin.end();
  nextLook_ = std::size_t(GrowthUntilThinLook * double(mesh_.vertexCount()));
}

void ParallelLearner::makeGrid()
{
  double sum = 0., count = 0.;
  for (std::size_t v = 0; v < mesh_.indexEnd(); v += 1 + mesh_.indexEnd() / VerticesOfMeanEdge)
  {
    for (const VertexIndex neighbor : mesh_.ring(VertexIndex(v)))
    {
      sum +=
        double(std::sqrt(squaredNorm(mesh_.position(neighbor) - mesh_.position(VertexIndex(v)))));
      count += 1.;
    }
  }
  const float width = GridEdgesPerCell * float(sum / std::max(1., count));
  grid_.build(mesh_, boxMin_, boxMax_, width, executor_);
  crowds_.reset();
  if (grid_.mostInCell() > MostInPackedCell)
  {
    crowds_.emplace();
    crowds_->reset(boxMin_, boxMax_, width, mesh_.indexEnd());
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (mesh_.isAlive(v))
      {
        crowds_->insert(v, mesh_.position(v));
      }
    }
  }
}

VertexIndex ParallelLearner::closestTo(Vector4 point) const
{
  return crowds_ ? crowds_->closest(point, mesh_.positions()) : grid_.closest(point);
}

// --- The state as a whole ------------------------------------------------------------------------

void ParallelLearner::tidyIfGrown()
{
  if (mesh_.vertexCount() >= nextRenumbering_)
  {
    tidy();
  }
  if (hasThinParts_ && mesh_.vertexCount() >= nextLook_)
  {
    makeGrid();
    lookForThinParts();
  }
}

void ParallelLearner::compact()
{
  try
  {
    sortAlongCurve(mesh_, interruptible_);
  }
  catch (const Interrupted&)
  {
    // Only their order in memory would be better.
    return;
  }
  noteCompact();
}

/// The same to its end: how learning goes on depends on the order.
void ParallelLearner::tidy()
{
  sortAlongCurve(mesh_, executor_);
  noteCompact();
}

void ParallelLearner::sortAlongCurve(Mesh& mesh, const Executor& executor) const
{
  mesh.renumber(mortonPermutation(mesh, boxMin_, boxMax_, executor), executor);
}

void ParallelLearner::noteCompact()
{
  reserved_ = mesh_.indexEnd();
  nextRenumbering_ = 1 + std::size_t(GrowthUntilTidy * double(mesh_.vertexCount()));
}

void ParallelLearner::changeCloud(
  const PointCloud& from, const PointCloud& to, const Parameters& parameters)
{
  parameters_.numberOfVertices = parameters.numberOfVertices;
  samples_ = StratifiedSamples(to.points(), parameters.seed, to.weights());
  isCoarse_ = isCoarse_ && mesh_.vertexCount() < verticesOfStage();
  boxMin_ = to.bulkMin();
  boxMax_ = to.bulkMax();
  for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
  {
    mesh_.setPosition(v, to.fromInput(from.toInput(mesh_.position(v))));
  }
  mesh_.releaseErased();
  tidy();
}

LearntMesh ParallelLearner::learntMesh() const
{
  LearntMesh result{ mesh_, {}, {} };
  result.mesh.dropProperties();
  result.activity = result.mesh.addProperty(0., OnSplit::Copy);
  const std::span<const float> activity = mesh_.values(activity_);
  std::copy(activity.begin(), activity.end(), result.mesh.values(result.activity).begin());
  result.mesh.dropErased(executor_);
  return result;
}

void ParallelLearner::exchange(Archive& archive)
{
  archive(counts_, mesh_);
  archive.require(mesh_.vertexCount() > 0);
  archive(samples_, noiseFilter_, winGain_);
  const std::uint64_t mostSamplesAfterGrowth = samplesAfterGrowth_;
  archive(nextAddition_, nextRemoval_, samplesAfterGrowth_);
  archive.require(samplesAfterGrowth_ <= mostSamplesAfterGrowth);
  archive(isCoarse_, hasThinParts_, nextLook_, nextRenumbering_);
  std::uint64_t left = isBatchOpen_ ? endOfTurn_ - counts_.iterations : 0;
  archive(isBatchOpen_, left);
  endOfTurn_ = counts_.iterations + left;
  if (archive.isReading())
  {
    updateDecay();
  }
}
}
