// SPDX-License-Identifier: BSD-3-Clause
// The other half of the algorithm: growth, with all splits and collapses that lie apart at once.
#include "learn/ParallelLearner.h"

#include "base/ParallelSort.h"
#include "base/Scattered.h"
#include "mesh/EdgeFlips.h"
#include "mesh/HalfEdgeCollapse.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

namespace neuralmesh
{
namespace
{
constexpr std::size_t VerticesPerPartOfGrowth = 2048;
constexpr std::size_t OperationsPerPart = 64;

/// Of those that are due, so many are asked for, as some lie too near to others.
constexpr double CandidatesPerSplit = 1.35;
constexpr double CandidatesPerCollapse = 2.7;
constexpr double MoreCandidates = 2.;
/// What could not be made stays due, but no more than for so many batches.
constexpr double MostBatchesDue = 1.5;
/// Splits for a collapse while the mesh is coarse.
constexpr std::uint64_t IntervalIfCoarse = 2;
/// Quantiles of activity are those of so many vertices.
constexpr std::size_t VerticesOfQuantile = 2048;
/// Memory for more than all vertices: those that a batch adds before the ones that it removes are used again.
constexpr double RoomForBatch = 1.03;

/// Any split is more urgent than any collapse; of splits those of the most active vertices, of collapses those of
/// the laziest. Numbers above 0 have the order of their bits.
constexpr std::uint32_t FirstOfSplits = 0x20000000u;

std::uint64_t keyOf(VertexIndex v, float activity, bool isSplit)
{
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(activity) >> 2;
  const std::uint32_t urgency = isSplit ? FirstOfSplits + bits : FirstOfSplits - 1 - bits;
  return std::uint64_t(urgency) << 32 | scattered(v);
}

bool isSplitKey(std::uint64_t key) { return (key >> 32) >= FirstOfSplits; }
}

void ParallelLearner::grow()
{
  if (counts_.iterations < nextAddition_)
  {
    return;
  }
  begin(Step::NodeAddition);
  const Quota due = quota();
  select(due);
  plan();
  commit(due);
  make();
  updateDecay();
  begin(Step::Basic);
}

/// Every C_vs samples a split, every C_nr splits a collapse. A mesh that wanders takes as many away as it adds.
ParallelLearner::Quota ParallelLearner::quota() const
{
  Quota result;
  result.interval =
    std::max<std::uint64_t>(1, std::uint64_t(patience() * parameters_.samplesPerAddition));
  const auto most =
    1 + std::uint64_t(MostBatchesDue * double(batch_.size()) / double(result.interval));
  result.splits = std::min(1 + (counts_.iterations - nextAddition_) / result.interval, most);
  if (hasAllVertices())
  {
    result.collapses = result.splits;
    result.mostCollapses = double(result.splits);
    return result;
  }
  const std::uint64_t additions = counts_.additions + result.splits;
  const std::uint64_t interval = intervalOfRemovals();
  result.collapses = additions >= nextRemoval_ ? 1 + (additions - nextRemoval_) / interval : 0;
  result.mostCollapses = parameters_.removalLimit > 0.
    ? std::ceil(parameters_.removalLimit * double(interval)) * double(result.collapses)
    : double(mesh_.vertexCount());
  return result;
}

/// C_nr, or less of it while the mesh is coarse: what is not right then would be so four times.
std::uint64_t ParallelLearner::intervalOfRemovals() const
{
  return isCoarse_ ? std::min(IntervalIfCoarse, removalInterval()) : removalInterval();
}

/// The key that about so many vertices exceed, by some of them.
std::uint64_t ParallelLearner::keyOfRank(bool isSplit, double rank)
{
  const std::span<const float> activity = std::as_const(mesh_).values(activity_);
  someKeys_.clear();
  const std::size_t stride = 1 + mesh_.indexEnd() / VerticesOfQuantile;
  for (std::size_t v = 0; v < mesh_.indexEnd(); v += stride)
  {
    if (mesh_.isAlive(VertexIndex(v)))
    {
      someKeys_.push_back(keyOf(VertexIndex(v), activity[v], isSplit));
    }
  }
  if (someKeys_.empty())
  {
    return 0;
  }
  const double part = rank / double(mesh_.vertexCount());
  const auto place = std::ptrdiff_t(
    std::min(double(someKeys_.size() - 1), std::ceil(part * double(someKeys_.size()))));
  std::nth_element(someKeys_.begin(), someKeys_.begin() + place, someKeys_.end(), std::greater<>());
  return someKeys_[std::size_t(place)];
}

/// The vertices to be asked: the most active ones, and the laziest ones with those that are idle.
void ParallelLearner::select(const Quota& quota)
{
  constexpr std::uint64_t Never = std::numeric_limits<std::uint64_t>::max();
  const bool removes = quota.collapses > 0;
  const std::uint64_t busyFrom =
    keyOfRank(true, CandidatesPerSplit * double(quota.splits) + MoreCandidates);
  const std::uint64_t lazyFrom = removes
    ? keyOfRank(false, CandidatesPerCollapse * double(quota.collapses) + MoreCandidates)
    : Never;
  const std::uint64_t idleFrom = removes ? keyOfRank(false, quota.mostCollapses) : Never;
  const auto idle = float(idleActivity());
  const float busy = hasAllVertices() ? float(busyActivity()) : 0.f;
  const std::span<const float> activity = std::as_const(mesh_).values(activity_);
  const std::size_t parts =
    (mesh_.indexEnd() + VerticesPerPartOfGrowth - 1) / VerticesPerPartOfGrowth;
  found_.resize(parts);
  executor_.forEachRange(mesh_.indexEnd(), VerticesPerPartOfGrowth,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<Reservations::Request>& found = found_[begin / VerticesPerPartOfGrowth];
      found.clear();
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const std::uint64_t splitKey = keyOf(v, activity[v], true);
        const std::uint64_t collapseKey = keyOf(v, activity[v], false);
        const bool isBusy = splitKey >= busyFrom && activity[v] >= busy;
        const bool isLazy =
          collapseKey >= lazyFrom || (activity[v] < idle && collapseKey >= idleFrom);
        if ((isBusy || isLazy) && mesh_.isAlive(v))
        {
          found.push_back({ v, isBusy ? splitKey : collapseKey });
        }
      }
    });
  requests_.clear();
  for (const std::vector<Reservations::Request>& found : found_)
  {
    requests_.insert(requests_.end(), found.begin(), found.end());
  }
}

/// How those that have the surface around them for themselves would be made. Where that is not legal, others get their
/// turn.
void ParallelLearner::plan()
{
  const std::span<const std::uint8_t> isGranted = reservations_.decide(mesh_, requests_, executor_);
  operations_.clear();
  for (std::size_t i = 0; i < requests_.size(); ++i)
  {
    if (isGranted[i] != 0)
    {
      operations_.push_back({ requests_[i], {}, NoVertex, 0 });
    }
  }
  executor_.forEachRange(operations_.size(), OperationsPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        Operation& operation = operations_[i];
        const VertexIndex v = operation.request.vertex;
        if (isSplitKey(operation.request.key))
        {
          operation.split = planVertexSplit(mesh_, v);
        }
        else
        {
          operation.other = bestCollapse(mesh_, v);
        }
      }
    });
  const std::span<float> activity = mesh_.values(activity_);
  std::erase_if(operations_,
    [&](const Operation& operation)
    {
      const VertexIndex v = operation.request.vertex;
      if (operation.split || operation.other != NoVertex)
      {
        return false;
      }
      ++counts_.illegalOperations;
      activity[v] = isSplitKey(operation.request.key) ? 0.5f * activity[v] : activity[v] + 1.f;
      return true;
    });
}

/// Which of them are made: the most urgent ones, as many as are due, and collapses of idle vertices; never more
/// vertices than there are to be. In the order of their vertices, as new ones get their indices.
void ParallelLearner::commit(const Quota& quota)
{
  const auto firstCollapse = std::stable_partition(operations_.begin(), operations_.end(),
    [](const Operation& operation) { return isSplitKey(operation.request.key); });
  std::vector<Operation> splits(operations_.begin(), firstCollapse);
  std::vector<Operation> collapses(firstCollapse, operations_.end());
  const auto byUrgency = [](const Operation& a, const Operation& b)
  { return a.request.key > b.request.key; };
  stableSort(splits, byUrgency, executor_);
  stableSort(collapses, byUrgency, executor_);
  const auto keep = [](std::vector<Operation>& operations, std::size_t most)
  { operations.resize(std::min(operations.size(), most)); };

  const bool isFull = hasAllVertices();
  if (isFull)
  {
    keep(collapses, std::min<std::size_t>(quota.collapses, splits.size()));
  }
  const std::span<const float> activity = std::as_const(mesh_).values(activity_);
  const auto idle = float(idleActivity());
  std::size_t gone = 0;
  while (gone < collapses.size() && double(gone) < quota.mostCollapses &&
    (gone < quota.collapses || activity[collapses[gone].request.vertex] < idle))
  {
    ++gone;
  }
  keep(collapses, gone);
  const std::size_t most = verticesOfStage() + gone;
  const std::size_t room = most - std::min(mesh_.vertexCount(), most);
  keep(splits, std::min<std::size_t>(quota.splits, room));

  const auto byVertex = [](const Operation& a, const Operation& b)
  { return a.request.vertex < b.request.vertex; };
  stableSort(splits, byVertex, executor_);
  stableSort(collapses, byVertex, executor_);
  reserve(splits.size());
  const std::vector<VertexIndex> added = mesh_.addVertices(splits.size());
  reservations_.resize(mesh_.indexEnd());
  for (std::size_t i = 0; i < splits.size(); ++i)
  {
    splits[i].other = added[i];
    reservations_.give(added[i], splits[i].request);
  }
  counts_.additions += splits.size();
  counts_.removals += collapses.size();
  nextAddition_ += splits.size() * quota.interval;
  if (isFull)
  {
    nextAddition_ = std::max(nextAddition_, counts_.iterations);
  }
  else
  {
    nextRemoval_ +=
      std::min<std::uint64_t>(collapses.size(), quota.collapses) * intervalOfRemovals();
  }
  operations_ = std::move(splits);
  operations_.insert(operations_.end(), collapses.begin(), collapses.end());
}

void ParallelLearner::make()
{
  const std::span<float> activity = mesh_.values(activity_);
  executor_.forEachRange(operations_.size(), OperationsPerPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        Operation& operation = operations_[i];
        const auto& [v, key] = operation.request;
        const VertexIndex other = operation.other;
        const std::uint64_t held = Reservations::heldBy(operation.request);
        const auto flipAround = [&](VertexIndex u)
        { operation.flips += flipMarkedEdgesAround(mesh_, u, reservations_.holders(), held); };
        if (isSplitKey(key))
        {
          const VertexSplit& split = *operation.split;
          mesh_.splitInto(v, split.first, split.steps, split.position, other);
          const auto kept = float(shareOfSplit(mesh_, v, other));
          activity[other] = (1.f - kept) * activity[v];
          activity[v] = kept * activity[v];
          flipAround(v);
        }
        else
        {
          mesh_.collapseOnly(v, other);
        }
        flipAround(other);
      }
    });
  std::vector<VertexIndex> removed;
  for (const Operation& operation : operations_)
  {
    counts_.flips += operation.flips;
    if (!isSplitKey(operation.request.key))
    {
      removed.push_back(operation.request.vertex);
    }
  }
  mesh_.eraseVertices(removed);
}

/// Memory up to the next renumbering, and for what a batch may add beyond.
void ParallelLearner::reserve(std::size_t added)
{
  if (const std::size_t needed = mesh_.indexEnd() + added; needed > reserved_)
  {
    const double all = RoomForBatch * double(parameters_.numberOfVertices);
    const double next = 1.1 * double(nextRenumbering_);
    reserved_ = std::max(needed, std::size_t(std::min(all, next)));
    mesh_.reserve(reserved_, executor_);
  }
}
}
