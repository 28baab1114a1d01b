// SPDX-License-Identifier: BSD-3-Clause
#include "run/Levels.h"

#include "learn/StoppingRules.h"
#include "mesh/QuadricSimplification.h"
#include "run/Exclusions.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The part of growth in the progress of a level.
constexpr double PartOfGrowth = 0.5;
/// Of the progress of a level that is simplified.
constexpr double PartOfMaking = 0.9;
/// Of the whole progress, the ends of the first run of the largest level, of the largest level, of those that grow, of
/// those that are simplified from it, and of the mesh for those that have lost parts.
constexpr double EndOfFirstRun = 0.5, EndOfLargest = 0.6, EndOfGrown = 0.75, EndOfSimplified = 0.9,
                 EndOfSecondLargest = 0.95;
/// Rounds of the fidelity smooth noise. In a mesh of fewer than half of the vertices they would smooth thin parts, too.
constexpr std::uint64_t TimesFewerIfNoisy = 2;

/// The levels [first, last) through which one mesh grows.
struct Chain
{
  std::size_t first;
  std::size_t last;
};

/// A mesh grows from the first surface of the largest level to all levels that are larger than that
/// surface. For the smaller levels, the surface is simplified to suit the largest of them, and so
/// on.
std::vector<Chain> chainsOf(std::span<const std::uint64_t> levels, Fidelity fidelity)
{
  std::vector<Chain> result;
  for (std::size_t last = levels.size(); last > 0;)
  {
    std::size_t first = last - 1;
    while (first > 0 && levels[first - 1] > firstVertices(levels[last - 1], fidelity))
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
Beginning simplified(
  Beginning beginning, std::uint64_t vertices, std::uint64_t fewer, Fidelity fidelity)
{
  if (beginning.mesh && fewer < vertices)
  {
    const double part =
      double(firstVertices(fewer, fidelity)) / double(firstVertices(vertices, fidelity));
    simplifyByQuadrics(*beginning.mesh, std::size_t(part * double(beginning.mesh->vertexCount())));
  }
  return beginning;
}

/// Whether a level may be simplified from the largest one. Without a fit, it would stay as it is then, and feature
/// strength belongs to the places where vertices have learnt.
bool maySimplify(const Parameters& parameters)
{
  return parameters.fitRounds > 0 && !parameters.computeFeatureStrength;
}

/// What a level is asked for.
Parameters parametersOf(std::uint64_t vertices, const RunRequest& request)
{
  Parameters result = request.parameters;
  result.numberOfVertices = vertices;
  return result;
}

/// A level that is not the largest.
struct SmallerLevel
{
  std::size_t number;
  std::uint64_t vertices;
  std::optional<Reconstruction> mesh;
};

/// The mesh from which levels are simplified.
enum class Source
{
  Finished,  ///< like any other
  ToSimplify ///< as that of a run whose mesh has lost thin parts
};

/// Simplifies a mesh to the levels, fits each, and keeps those that hold more of the cloud than what they had. Returns
/// false if that was ended.
bool simplifyTo(std::span<SmallerLevel* const> levels, Source source, std::uint64_t largest,
  Run& run, LearntRun& made, const RunRequest& request, ProgressPart part, const Progress& progress)
{
  if (levels.empty())
  {
    return true;
  }
  std::vector<std::size_t> counts;
  for (const SmallerLevel* level : levels)
  {
    counts.insert(counts.begin(), std::size_t(level->vertices));
  }
  bool isComplete = true;
  auto next = levels.rbegin();
  simplifyByQuadricsToEach(made.learnt.mesh, counts,
    [&]
    {
      SmallerLevel& level = **next;
      LearntRun copy(made);
      copy.learnt.mesh.dropErased();
      copy.result.times = {};
      copy.result.times.enter(Phase::Finish);
      const double share = (part.end - part.begin) / double(levels.size());
      const double begin = part.begin + share * double(next - levels.rbegin());
      const ProgressPart making{ begin, begin + PartOfMaking * share };
      const bool hasFidelity = source == Source::Finished &&
        (copy.result.finish->isClean || TimesFewerIfNoisy * level.vertices >= largest);
      hasFidelity ? run.makeAgain(copy, level.vertices, making)
                  : run.makeSimplified(copy, level.vertices, making);
      copy.result.times.leave();
      Reconstruction mesh =
        run.describe(std::move(copy), level.vertices, { making.end, begin + share });
      isComplete = mesh.isComplete();
      if (isComplete && level.mesh)
      {
        level.mesh = betterOf(*level.mesh, std::move(mesh), holdsMore);
      }
      else if (isComplete)
      {
        level.mesh = mesh;
        const Parameters parameters = parametersOf(level.vertices, request);
        const double end = begin + share;
        mesh =
          betterRun(std::move(mesh), requestWith(request, parameters), partOf(progress, end, end));
        isComplete = mesh.isComplete();
        if (isComplete)
        {
          level.mesh = std::move(mesh);
        }
      }
      ++next;
      return isComplete;
    });
  return isComplete;
}

/// Receives a level that has grown, with the request and the progress for a run of its own. Returns whether to go on.
using LevelGrown = std::function<bool(
  std::size_t level, Reconstruction mesh, const RunRequest& own, const Progress& atTheEnd)>;

/// One mesh that grows, and a copy of it at each level that is finished. Returns false if `take` does.
bool growTo(std::span<const std::uint64_t> levels, Run& run, const Beginning& beginning,
  std::uint64_t vertices, const RunRequest& request, ProgressPart part, const Progress& progress,
  const LevelGrown& take)
{
  Checkpoint none({}, request.cloud, request.parameters);
  const double all = std::accumulate(levels.begin(), levels.end(), 0.);
  double done = part.begin;
  for (const Chain& chain : chainsOf(levels, request.parameters.fidelity))
  {
    Beginning next =
      simplified(beginning, vertices, levels[chain.last - 1], request.parameters.fidelity);
    for (std::size_t level = chain.first; level < chain.last; ++level)
    {
      const Parameters parameters = parametersOf(levels[level], request);
      const RunRequest own = requestWith(request, parameters);
      const double end = done + (part.end - part.begin) * double(levels[level]) / all;
      const double endOfGrowth = done + PartOfGrowth * (end - done);
      LearntRun learnt =
        run.learn(verticesToLearn(own), std::move(next), { done, endOfGrowth }, none);
      // A first surface that is larger than the level learns nothing. It is finished all the same.
      learnt.isLearnt = true;
      next = { learnt.learnt.mesh, beginning.gaps, beginning.weights };
      Reconstruction result = run.finish(std::move(learnt), levels[level], { endOfGrowth, end });
      const Progress atTheEnd = partOf(progress, end, end);
      if (!take(level, betterRun(std::move(result), own, atTheEnd), own, atTheEnd))
      {
        return false;
      }
      done = end;
    }
  }
  return true;
}

/// The largest level, and what is known of how it came about.
struct LargestLevel
{
  Reconstruction result;
  Beginning beginning;
  LearntRun learnt; ///< before its fit
  LearntRun made;   ///< before it was described

  /// Whether it was simplified from a finer mesh, as the first one had lost thin parts.
  bool isFromFiner() const { return made.vertices > learnt.vertices; }
  bool isClean() const { return made.result.finish && made.result.finish->isClean; }
  /// Whether the surface is closed, with noise, and has all parts. Then a smaller level may be worse if it is simplified:
  /// even triangles average noise better, and rounds that smooth it round off the rims of thin parts.
  bool isNoisySolid() const { return !isClean() && !isFromFiner() && !made.learnt.mesh.isOpen(); }
  /// The number of vertices from which on a level grows. Only a front has more than planned, as thin parts need them: a
  /// coarser mesh that grows would lose these.
  std::uint64_t leastToGrow(Fidelity fidelity) const
  {
    const std::uint64_t first = beginning.mesh ? beginning.mesh->vertexCount() : 0;
    return !isNoisySolid()                               ? std::numeric_limits<std::uint64_t>::max()
      : first > firstVertices(learnt.vertices, fidelity) ? first
                                                         : 0;
  }
};

LargestLevel largestLevel(
  std::uint64_t vertices, Run& run, const RunRequest& request, const Progress& progress)
{
  const Parameters parameters = parametersOf(vertices, request);
  const RunRequest own = requestWith(request, parameters);
  PhaseTimes times;
  times.enter(Phase::Start);
  Beginning beginning = run.begin(vertices, { 0., EndOfFirstRun * StartOfLearning });
  times.leave();
  Checkpoint none({}, request.cloud, request.parameters);
  LearntRun learnt = run.learn(verticesToLearn(own), beginning,
    { EndOfFirstRun * StartOfLearning, EndOfFirstRun * EndOfLearning }, none);
  learnt.isLearnt = true;
  std::optional<LearntRun> made;
  Reconstruction result =
    run.finish(learnt, vertices, { EndOfFirstRun * EndOfLearning, EndOfFirstRun },
      [&made](const LearntRun& last) { made.emplace(last); });
  result.times.add(times);
  const double middle = 0.5 * (EndOfFirstRun + EndOfLargest);
  const Progress better = partOf(progress, EndOfFirstRun, middle),
                 thin = partOf(progress, middle, EndOfLargest);
  result = runWithThinParts(betterRun(std::move(result), own, better), own, thin, &*made);
  return { std::move(result), std::move(beginning), std::move(learnt), *std::move(made) };
}

/// Makes the smaller levels. Those of a solid with noise that have lost parts are made once more: those that have grown
/// of the largest, others as runs of their own would make them. Returns false if that was ended.
bool makeLevels(std::vector<SmallerLevel>& levels, std::uint64_t vertices, Run& run,
  LargestLevel& largest, const RunRequest& request, const Progress& progress)
{
  const std::uint64_t leastToGrow = largest.leastToGrow(request.parameters.fidelity);
  std::vector<SmallerLevel*> toSimplify, toRepeat;
  std::vector<SmallerLevel*> grown;
  std::vector<std::uint64_t> numbers;
  for (SmallerLevel& level : levels)
  {
    if (level.vertices < leastToGrow)
    {
      toSimplify.push_back(&level);
    }
    else
    {
      grown.push_back(&level);
      numbers.push_back(level.vertices);
    }
  }
  const auto takeGrown =
    [&](std::size_t index, Reconstruction mesh, const RunRequest& own, const Progress&)
  {
    if (!mesh.isComplete())
    {
      return false;
    }
    if (mayHaveLostThinParts(mesh, own))
    {
      toSimplify.push_back(grown[index]);
    }
    grown[index]->mesh = std::move(mesh);
    return true;
  };
  if (!growTo(numbers, run, largest.beginning, vertices, request, { EndOfLargest, EndOfGrown },
        progress, takeGrown))
  {
    return false;
  }
  std::ranges::sort(toSimplify, {}, &SmallerLevel::vertices);
  if (!simplifyTo(toSimplify, largest.isFromFiner() ? Source::ToSimplify : Source::Finished,
        vertices, run, largest.made, request, { EndOfGrown, EndOfSimplified }, progress))
  {
    return false;
  }
  for (SmallerLevel* level : toSimplify)
  {
    const Parameters parameters = parametersOf(level->vertices, request);
    if (largest.isNoisySolid() && level->vertices < leastToGrow &&
      mayHaveLostThinParts(*level->mesh, requestWith(request, parameters)))
    {
      toRepeat.push_back(level);
    }
  }
  if (toRepeat.empty())
  {
    return progress(1.);
  }
  PhaseTimes times;
  times.enter(Phase::Finish);
  const bool isFitted = run.makeToSimplify(largest.learnt, { EndOfSimplified, EndOfSecondLargest });
  times.leave();
  largest.result.times.add(times);
  return isFitted &&
    simplifyTo(toRepeat, Source::ToSimplify, vertices, run, largest.learnt, request,
      { EndOfSecondLargest, 1. }, progress);
}

/// The largest level, of which smaller ones are simplified where that is better.
Reconstruction reconstructFromLargest(const RunRequest& request,
  std::span<const std::uint64_t> levels, const LevelTaker& take, const Progress& progress)
{
  Run run(request, progress);
  LargestLevel largest = largestLevel(levels.back(), run, request, progress);
  std::vector<SmallerLevel> smaller;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
  {
    smaller.push_back({ level, levels[level], {} });
  }
  if (largest.result.isComplete() && !smaller.empty() &&
    !makeLevels(smaller, levels.back(), run, largest, request, progress))
  {
    largest.result.stopReason = StopReason::Cancelled;
  }
  for (SmallerLevel& level : smaller)
  {
    if (level.mesh)
    {
      take(level.number, *std::move(level.mesh));
    }
  }
  return std::move(largest.result);
}

/// All levels grow.
Reconstruction reconstructGrown(const RunRequest& request, std::span<const std::uint64_t> levels,
  const LevelTaker& take, const Progress& progress)
{
  PhaseTimes times;
  times.enter(Phase::Start);
  Run run(request, progress);
  const Beginning beginning = run.begin(levels.back(), { 0., StartOfLearning });
  times.leave();
  Reconstruction last;
  growTo(levels, run, beginning, levels.back(), request, { StartOfLearning, 1. }, progress,
    [&](std::size_t level, Reconstruction mesh, const RunRequest& own, const Progress& atTheEnd)
    {
      mesh.times.add(std::exchange(times, {}));
      mesh = runWithThinParts(std::move(mesh), own, atTheEnd);
      const bool goesOn = level + 1 < levels.size() && mesh.isComplete();
      if (goesOn)
      {
        take(level, std::move(mesh));
      }
      else
      {
        last = std::move(mesh);
      }
      return goesOn;
    });
  return last;
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
  const Progress told = rising(progress);
  return maySimplify(request.parameters) ? reconstructFromLargest(request, levels, take, told)
                                         : reconstructGrown(request, levels, take, told);
}
}
