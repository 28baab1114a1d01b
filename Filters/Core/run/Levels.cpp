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

/// A level that may have lost thin parts.
struct DoubtfulLevel
{
  std::size_t number;
  Reconstruction mesh;
};

/// Gives the doubtful levels to `take`. A level is replaced by a simplification of the last level,
/// `learnt`, if that holds more of the cloud. If the last level has lost thin parts itself,
/// `learnt` is nothing, and each level is checked by a run of its own.
void takeDoubtful(Run& run, const std::optional<LearntRun>& learnt, const RunRequest& request,
  Reconstruction& last, std::vector<DoubtfulLevel>& doubtful, const LevelTaker& take,
  const Progress& progress)
{
  for (auto& [number, mesh] : doubtful)
  {
    Parameters parameters = request.parameters;
    parameters.numberOfVertices = mesh.surface.vertexCount();
    if (last.isComplete())
    {
      Reconstruction other = learnt
        ? betterOf(mesh, run.finish(*learnt, parameters.numberOfVertices, { 1., 1. }), holdsMore)
        : runWithThinParts(mesh, requestWith(request, parameters), progress);
      if (other.stopReason == StopReason::Cancelled)
      {
        last.stopReason = StopReason::Cancelled;
      }
      else
      {
        mesh = std::move(other);
      }
    }
    take(number, std::move(mesh));
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
  const LevelTaker keep = [&waiting](std::size_t level, Reconstruction mesh)
  { waiting.emplace(level, std::move(mesh)); };
  const double all = std::accumulate(levels.begin(), levels.end(), 0.);
  double done = StartOfLearning;
  for (const Chain& chain : chainsOf(levels))
  {
    Beginning next = simplified(beginning, levels.back(), levels[chain.last - 1]);
    for (std::size_t level = chain.first; level < chain.last; ++level)
    {
      Parameters parameters = request.parameters;
      parameters.numberOfVertices = levels[level];
      const RunRequest own = requestWith(request, parameters);
      const double end = done + (1. - StartOfLearning) * double(levels[level]) / all;
      const double endOfGrowth = done + PartOfGrowth * (end - done);
      LearntRun learnt =
        run.learn(verticesToLearn(own), std::move(next), { done, endOfGrowth }, none);
      // A first surface that is larger than its level learns nothing. It is finished and simplified
      // all the same.
      learnt.isLearnt = true;
      next = { learnt.learnt.mesh, beginning.gaps, beginning.weights };
      const bool isLast = level + 1 == levels.size();
      auto learntForDoubtful =
        isLast && !doubtful.empty() ? std::optional<LearntRun>(learnt) : std::nullopt;
      Reconstruction result =
        betterRun(run.finish(std::move(learnt), levels[level], { endOfGrowth, end }), own,
          partOf(progress, end, end));
      result.times.add(std::exchange(times, {}));
      if (mayHaveLostThinParts(result, own))
      {
        learntForDoubtful.reset();
      }
      if (isLast)
      {
        result = runWithThinParts(std::move(result), own, partOf(progress, end, end));
      }
      if (isLast || !result.isComplete())
      {
        takeDoubtful(
          run, learntForDoubtful, request, result, doubtful, keep, partOf(progress, end, end));
        for (auto& [number, mesh] : waiting)
        {
          take(number, std::move(mesh));
        }
        return result;
      }
      if (mayHaveLostThinParts(result, own))
      {
        doubtful.push_back({ level, std::move(result) });
      }
      else
      {
        (doubtful.empty() ? take : keep)(level, std::move(result));
      }
      done = end;
    }
  }
  return {};
}
}
