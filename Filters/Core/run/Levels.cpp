// SPDX-License-Identifier: BSD-3-Clause
#include "run/Levels.h"

#include "learn/StoppingRules.h"
#include "mesh/QuadricSimplification.h"
#include "run/Exclusions.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

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

/// Whether the mesh is fitted and may be fitted again. Feature strength belongs to the places where
/// vertices have learnt.
bool canBeMadeAgain(const LearntRun& run)
{
  return run.result.finish && !run.learnt.featureStrength;
}

/// The levels below the last one.
struct SmallerLevels
{
  std::vector<Reconstruction> meshes;
  std::vector<std::size_t> doubtful; ///< those that may have lost thin parts, ascending
};

/// Replaces each doubtful level by a simplification of the last level, `made`, if that holds more of
/// the cloud. `made` is fitted, so few rounds fit the simplification. If the last level has lost
/// thin parts itself, `made` is nothing, and each level is checked by a run of its own. Returns
/// false if the run was ended.
bool replaceDoubtful(Run& run, const std::optional<LearntRun>& made, const RunRequest& request,
  SmallerLevels& smaller, const Progress& progress)
{
  for (const std::size_t level : smaller.doubtful)
  {
    Reconstruction& mesh = smaller.meshes[level];
    Parameters parameters = request.parameters;
    parameters.numberOfVertices = mesh.surface.vertexCount();
    Reconstruction other;
    if (made)
    {
      LearntRun again = *made;
      again.result.times = {};
      again.result.times.enter(Phase::Finish);
      run.makeAgain(again, parameters.numberOfVertices, { 1., 1. });
      again.result.times.leave();
      other = betterOf(
        mesh, run.describe(std::move(again), parameters.numberOfVertices, { 1., 1. }), holdsMore);
    }
    else
    {
      other = runWithThinParts(mesh, requestWith(request, parameters), progress);
    }
    if (other.stopReason == StopReason::Cancelled)
    {
      return false;
    }
    mesh = std::move(other);
  }
  return true;
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
  SmallerLevels smaller;
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
      const double endOfFit = request.parameters.computeUncertainty
        ? endOfGrowth + PartBeforeUncertainty * (end - endOfGrowth)
        : end;
      LearntRun learnt =
        run.learn(verticesToLearn(own), std::move(next), { done, endOfGrowth }, none);
      // A first surface that is larger than its level learns nothing. It is finished and simplified
      // all the same.
      learnt.isLearnt = true;
      next = { learnt.learnt.mesh, beginning.gaps, beginning.weights };
      const bool isLast = level + 1 == levels.size();
      learnt.result.times.enter(Phase::Finish);
      run.make(learnt, levels[level], { endOfGrowth, endOfFit });
      learnt.result.times.leave();
      auto made = isLast && !smaller.doubtful.empty() && canBeMadeAgain(learnt)
        ? std::optional<LearntRun>(learnt)
        : std::nullopt;
      Reconstruction result =
        betterRun(run.describe(std::move(learnt), levels[level], { endOfFit, end }), own,
          partOf(progress, end, end));
      result.times.add(std::exchange(times, {}));
      const bool isDoubtful = mayHaveLostThinParts(result, own);
      if (isDoubtful)
      {
        made.reset();
      }
      if (isLast)
      {
        result = runWithThinParts(std::move(result), own, partOf(progress, end, end));
        if (result.isComplete() &&
          !replaceDoubtful(run, made, request, smaller, partOf(progress, end, end)))
        {
          result.stopReason = StopReason::Cancelled;
        }
      }
      if (isLast || !result.isComplete())
      {
        for (std::size_t number = 0; number < smaller.meshes.size(); ++number)
        {
          take(number, std::move(smaller.meshes[number]));
        }
        return result;
      }
      if (isDoubtful)
      {
        smaller.doubtful.push_back(level);
      }
      smaller.meshes.push_back(std::move(result));
      done = end;
    }
  }
  return {};
}
}
