// SPDX-License-Identifier: BSD-3-Clause
#include "run/Levels.h"

#include "learn/StoppingRules.h"
#include "mesh/QuadricSimplification.h"
#include "run/Exclusions.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The part of growth in the progress of a level.
constexpr double PartOfGrowth = 0.5;
/// The part of the levels that grow in the whole progress, if others are simplified.
constexpr double EndOfGrownLevels = 0.7;

/// The levels [first, last) through which one mesh grows.
struct Chain
{
  std::size_t first;
  std::size_t last;
};

/// A mesh grows from the first surface of the largest level to all levels that are larger than that
/// surface. For the smaller levels, the surface is simplified to suit the largest of them, and so
/// on.
std::vector<Chain> chainsOf(std::span<const std::uint64_t> levels)
{
  std::vector<Chain> result;
  for (std::size_t last = levels.size(); last > 0;)
  {
    std::size_t first = last - 1;
    while (first > 0 && levels[first - 1] > firstVertices(levels[last - 1]))
    {
      --first;
    }
    result.insert(result.begin(), { first, last });
    last = first;
  }
  return result;
}

/// Simplifies the first surface for `vertices` vertices to one for `fewer`. It stays finer at thin
/// parts.
Beginning simplified(Beginning beginning, std::uint64_t vertices, std::uint64_t fewer)
{
  if (beginning.mesh && fewer < vertices)
  {
    const double part = double(firstVertices(fewer)) / double(firstVertices(vertices));
    simplifyByQuadrics(*beginning.mesh, std::size_t(part * double(beginning.mesh->vertexCount())));
  }
  return beginning;
}

/// The number of levels below a first surface that has more vertices than planned. Only a front has
/// more, as thin parts need them: a coarser mesh that grows would lose these.
std::size_t levelsBelowFront(
  const Beginning& beginning, std::span<const std::uint64_t> levels, const Parameters& parameters)
{
  const std::size_t there = beginning.mesh ? beginning.mesh->vertexCount() : 0;
  if (parameters.fitRounds == 0 || there <= firstVertices(levels.back()))
  {
    return 0;
  }
  const auto end = std::lower_bound(levels.begin(), levels.end() - 1, there);
  return std::size_t(end - levels.begin());
}

/// A level that is simplified from the last one.
struct DoubtfulLevel
{
  std::size_t number;
  std::uint64_t vertices;
  std::optional<Reconstruction> mesh; ///< that has grown, but may have lost thin parts
};

/// Simplifies a fitted mesh to the doubtful levels, and fits each. Keeps those that have grown and
/// hold more of the cloud. Returns false if that was ended.
bool simplifyTo(std::span<DoubtfulLevel> doubtful, Run& run, LearntRun& fitted,
  const RunRequest& request, ProgressPart part, const Progress& progress)
{
  std::vector<std::size_t> counts;
  for (const DoubtfulLevel& level : doubtful)
  {
    counts.insert(counts.begin(), std::size_t(level.vertices));
  }
  bool isComplete = true;
  auto level = doubtful.rbegin();
  simplifyByQuadricsToEach(fitted.learnt.mesh, counts,
    [&]
    {
      LearntRun copy(fitted);
      copy.learnt.mesh.dropErased();
      copy.result.times = {};
      copy.result.times.enter(Phase::Finish);
      const double share = (part.end - part.begin) / double(doubtful.size());
      const double begin = part.begin + share * double(level - doubtful.rbegin());
      const ProgressPart own{ begin, begin + share };
      run.makeSimplified(copy, level->vertices, own);
      copy.result.times.leave();
      Reconstruction mesh = run.describe(std::move(copy), level->vertices, own);
      isComplete = mesh.isComplete();
      if (isComplete && level->mesh)
      {
        level->mesh = betterOf(*level->mesh, std::move(mesh), holdsMore);
      }
      else if (isComplete)
      {
        level->mesh = mesh;
        Parameters parameters = request.parameters;
        parameters.numberOfVertices = level->vertices;
        mesh = betterRun(
          std::move(mesh), requestWith(request, parameters), partOf(progress, own.end, own.end));
        isComplete = mesh.isComplete();
        if (isComplete)
        {
          level->mesh = std::move(mesh);
        }
      }
      ++level;
      return isComplete;
    });
  return isComplete;
}

/// Makes the doubtful levels from the last one, `learnt`. If `last` has lost thin parts itself, each
/// level is checked by a run of its own. Levels stay as they were if that is ended: then `last` is
/// cancelled.
void makeDoubtful(std::vector<DoubtfulLevel>& doubtful, Run& run, LearntRun learnt,
  const RunRequest& request, bool isLastSound, Reconstruction& last, ProgressPart part,
  const Progress& progress)
{
  PhaseTimes times;
  times.enter(Phase::Finish);
  const double middle = (part.begin + part.end) / 2.;
  bool isComplete = run.makeToSimplify(learnt, { part.begin, middle });
  times.leave();
  last.times.add(times);
  isComplete =
    isComplete && simplifyTo(doubtful, run, learnt, request, { middle, part.end }, progress);
  for (DoubtfulLevel& level : doubtful)
  {
    if (isComplete && !isLastSound)
    {
      Parameters parameters = request.parameters;
      parameters.numberOfVertices = level.vertices;
      Reconstruction mesh =
        runWithThinParts(*level.mesh, requestWith(request, parameters), partOf(progress, 1., 1.));
      isComplete = mesh.stopReason != StopReason::Cancelled;
      if (isComplete)
      {
        level.mesh = std::move(mesh);
      }
    }
  }
  if (!isComplete)
  {
    last.stopReason = StopReason::Cancelled;
  }
}
}

std::string whyNoLevels(
  std::span<const std::uint64_t> levels, const Parameters& parameters, const BesideLevels& beside)
{
  constexpr std::uint64_t FewestOfLevel = 4;
  if (!levels.empty() && levels.front() < FewestOfLevel)
  {
    return "A level has at least 4 vertices.";
  }
  if (std::ranges::adjacent_find(levels, std::greater_equal<>()) != levels.end())
  {
    return "The levels must ascend: each needs more vertices than the one before.";
  }
  return whyExcluded("Levels",
    { { beside.firstMesh, "a first mesh or an ensemble" }, { beside.checkpoint, "a checkpoint" },
      { beside.snapshots, "growth as time" },
      { beside.automatic, "the automatic choice of parameters" },
      { mayEndBeforeVertices(parameters), "a stopping rule other than the number of vertices" } });
}

Reconstruction reconstructLevels(const RunRequest& request, std::span<const std::uint64_t> levels,
  const LevelTaker& take, const Progress& progress)
{
  PhaseTimes times;
  times.enter(Phase::Start);
  Run run(request, progress);
  const Beginning beginning = run.begin(levels.back(), { 0., StartOfLearning });
  times.leave();
  Checkpoint none({}, request.cloud, request.parameters);
  std::vector<DoubtfulLevel> doubtful;
  // Those from the first doubtful one on wait for it.
  std::map<std::size_t, Reconstruction> waiting;
  const std::size_t firstGrown = levelsBelowFront(beginning, levels, request.parameters);
  for (std::size_t level = 0; level < firstGrown; ++level)
  {
    doubtful.push_back({ level, levels[level], {} });
  }
  const double endOfGrown = firstGrown > 0 ? EndOfGrownLevels : 1.;
  const double all = std::accumulate(levels.begin() + std::ptrdiff_t(firstGrown), levels.end(), 0.);
  double done = StartOfLearning;
  for (const Chain& chain : chainsOf(levels))
  {
    if (chain.last <= firstGrown)
    {
      continue;
    }
    Beginning next = simplified(beginning, levels.back(), levels[chain.last - 1]);
    for (std::size_t level = std::max(chain.first, firstGrown); level < chain.last; ++level)
    {
      Parameters parameters = request.parameters;
      parameters.numberOfVertices = levels[level];
      const RunRequest own = requestWith(request, parameters);
      const double end = done + (endOfGrown - StartOfLearning) * double(levels[level]) / all;
      const double endOfGrowth = done + PartOfGrowth * (end - done);
      LearntRun learnt =
        run.learn(verticesToLearn(own), std::move(next), { done, endOfGrowth }, none);
      // A first surface that is larger than its level learns nothing. It is finished all the same.
      learnt.isLearnt = true;
      next = { learnt.learnt.mesh, beginning.gaps, beginning.weights };
      const bool isLast = level + 1 == levels.size();
      auto learntForDoubtful =
        isLast && !doubtful.empty() ? std::optional<LearntRun>(learnt) : std::nullopt;
      Reconstruction result =
        betterRun(run.finish(std::move(learnt), levels[level], { endOfGrowth, end }), own,
          partOf(progress, end, end));
      result.times.add(std::exchange(times, {}));
      const bool isDoubtful = mayHaveLostThinParts(result, own);
      if (isLast)
      {
        result = runWithThinParts(std::move(result), own, partOf(progress, end, end));
        if (learntForDoubtful && result.isComplete())
        {
          makeDoubtful(doubtful, run, *std::move(learntForDoubtful), request, !isDoubtful, result,
            { end, 1. }, progress);
        }
      }
      if (isLast || !result.isComplete())
      {
        for (DoubtfulLevel& smaller : doubtful)
        {
          if (smaller.mesh)
          {
            waiting.emplace(smaller.number, *std::move(smaller.mesh));
          }
        }
        for (auto& [number, mesh] : waiting)
        {
          take(number, std::move(mesh));
        }
        return result;
      }
      if (isDoubtful)
      {
        doubtful.push_back({ level, levels[level], std::move(result) });
      }
      else if (doubtful.empty())
      {
        take(level, std::move(result));
      }
      else
      {
        waiting.emplace(level, std::move(result));
      }
      done = end;
    }
  }
  return {};
}
}
