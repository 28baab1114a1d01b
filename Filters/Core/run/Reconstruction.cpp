// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"

#include "base/WarningTopic.h"
#include "fit/CreaseRefinement.h"
#include "mesh/Pieces.h"
#include "run/Run.h"

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <utility>

namespace neuralmesh
{
namespace
{
/// A mesh with fewer points per vertex follows single points, not the surface.
constexpr std::size_t PointsPerVertex = 2;
constexpr std::size_t LeastLearnt = 100;
/// A first surface with so many vertices shows a shape. In a draft more are fitted than that, as learning takes longer
/// for as many. Still more would follow noise.
constexpr std::uint64_t LeastForShape = 1500;
constexpr std::uint64_t FirstOfDraft = 2500;
/// A smaller mesh loses parts that are narrower than its edges while it learns. So it is simplified
/// from a mesh of this size, if there are twenty points per vertex.
constexpr std::uint64_t LeastLearntToFit = 1000;
constexpr std::uint64_t PointsToSimplify = 20;
/// A mesh that has lost thin or narrow parts is simplified from one of 20,000 or twice its
/// vertices, if there are five points per vertex.
constexpr std::uint64_t LearntForThinParts = 20000;
constexpr std::uint64_t TimesForThinParts = 2;
constexpr std::uint64_t MostLearntForThinParts = 100000;
constexpr std::uint64_t PointsToHoldThinParts = 5;
/// The two runs of a larger mesh would take too much memory.
constexpr std::uint64_t MostLearntForHoles = 200000;
/// A part of all points: a coarse mesh leaves some unexplained beside its bends.
constexpr double LeastDifferenceOfUnexplained = 0.005;
/// Residuals within this factor are a draw: a few points at creases make most of a residual.
constexpr double TimesOfDraw = 1.2;
/// Of the triangles: so few slivers are none.
constexpr double FewSlivers = 0.0002;
/// Of the progress, where other runs may follow.
constexpr double PartIfOthersMayFollow = 0.92;
/// Of what the first run leaves: the ends of betterRun() and of runWithThinParts().
constexpr double EndOfBetterRun = 0.5, EndOfThinParts = 0.8;

/// Whether learning starts from a surface that the points tell.
bool startsFromSpace(const RunRequest& request)
{
  return !request.first && request.parameters.start == Start::OccupiedSpace;
}

/// Learns from there, then simplifies or refines the mesh to the number of the parameters. `times` has the start.
Reconstruction learnAndFinish(Run& run, std::uint64_t vertices, Beginning beginning,
  const PhaseTimes& times, const RunRequest& request, Checkpoint& checkpoint,
  const GrowthWatch& watch, const std::function<void(const LearntRun&)>& made = {})
{
  const Parameters& parameters = request.parameters;
  const double startOfLearning = startsFromSpace(request) ? StartOfLearning : 0.;
  const double endOfLearning = parameters.fitRounds > 0 ? EndOfLearning : 1.;
  LearntRun learnt = run.learn(
    vertices, std::move(beginning), { startOfLearning, endOfLearning }, checkpoint, watch);
  Reconstruction result =
    run.finish(std::move(learnt), parameters.numberOfVertices, { endOfLearning, 1. }, made);
  result.times.add(times);
  return result;
}

/// The same with the start that the parameters ask for.
Reconstruction learnAndFinish(std::uint64_t vertices, const RunRequest& request,
  const Progress& progress, const GrowthWatch& watch, const CheckpointPlan& plan,
  const std::function<void(const LearntRun&)>& made = {})
{
  Checkpoint checkpoint(plan, request.cloud, request.parameters);
  PhaseTimes times;
  times.enter(Phase::Start);
  Run run(request, progress);
  Beginning beginning =
    run.begin(vertices, { 0., startsFromSpace(request) ? StartOfLearning : 0. });
  times.leave();
  return learnAndFinish(
    run, vertices, std::move(beginning), times, request, checkpoint, watch, made);
}

/// Whether a run may learn another number of vertices than asked. A first mesh is fitted as it is,
/// and stopping rules are meant for the mesh that learns.
bool mayLearnOtherwise(const Parameters& parameters)
{
  return parameters.fitRounds > 0 && !parameters.topologyLearning &&
    !mayEndBeforeVertices(parameters);
}

bool mayLearnOtherwise(const RunRequest& request)
{
  return !request.first && mayLearnOtherwise(request.parameters);
}

/// Whether a simplified mesh is what was asked for. Handles and pieces may need more vertices than
/// that, or leave too few for the rest. Growth of a large mesh may stop where that of a small one
/// does not.
bool isRight(const Reconstruction& simplified, std::uint64_t vertices)
{
  return simplified.stopReason == StopReason::Vertices &&
    simplified.surface.vertexCount() == vertices && simplified.finish &&
    simplified.finish->left.total() == 0;
}

/// Whether a coarser mesh may have sharper creases: the mesh has creases, but too few points per
/// vertex for them.
bool mayHaveRoundedCreases(const Reconstruction& result, const RunRequest& request)
{
  const Parameters& parameters = request.parameters;
  return result.stopReason == StopReason::Vertices && result.finish && result.finish->isClean &&
    parameters.fidelity != Fidelity::Draft && parameters.fitSmoothness == 0. &&
    !parameters.computeFeatureStrength &&
    result.surface.vertexCount() > request.cloud.differentCount() / PointsThatTellCreases &&
    hasCreases(result.surface, request.executor);
}

/// Whether the first mesh has so many vertices, and a residual below `times` that of the second.
bool isCloser(const Reconstruction& first, const Reconstruction& second, std::uint64_t vertices,
  double times = 1.)
{
  return first.surface.vertexCount() == vertices && first.quality && second.quality &&
    first.quality->residual < times * second.quality->residual;
}

/// See holdsMore() of Run.h; with so many warnings that count.
bool holdsMore(const Reconstruction& finer, const Reconstruction& other, std::size_t warnings,
  std::size_t otherWarnings)
{
  if (finer.stopReason != StopReason::Vertices || !finer.finish || !finer.explanation ||
    finer.surface.vertexCount() != other.surface.vertexCount() ||
    finer.explanation->unexplainedShare() >
      other.explanation->unexplainedShare() + LeastDifferenceOfUnexplained)
  {
    return false;
  }
  const DefectCount &left = finer.finish->left, &before = other.finish->left;
  const bool hasNoMoreDefects = left.total() <= before.total();
  if (warnings < otherWarnings)
  {
    return hasNoMoreDefects || left.intersectingTriangles <= before.intersectingTriangles;
  }
  return warnings == otherWarnings && hasNoMoreDefects &&
    isCloser(finer, other, other.surface.vertexCount());
}

/// The same for a closed mesh with as many handles or more, which may be right and narrow.
bool holdsMoreWithHoles(const Reconstruction& withHoles, const Reconstruction& other)
{
  if (withHoles.surface.isOpen() || genusOf(withHoles.surface) < genusOf(other.surface))
  {
    return false;
  }
  const auto countOf = [](const Reconstruction& result)
  {
    return std::size_t(std::ranges::count_if(result.warnings,
      [](const std::string& warning) { return !isAbout(warning, WarningTopic::NarrowHandles); }));
  };
  return holdsMore(withHoles, other, countOf(withHoles), countOf(other));
}

/// Whether a closed mesh may have filled holes that the grid of its first surface did not show.
bool mayHaveFilledHoles(const Reconstruction& result, const RunRequest& request)
{
  using enum WarningTopic;
  return result.isFromGrid && mayLearnOtherwise(request) &&
    request.parameters.numberOfVertices <= MostLearntForHoles &&
    request.parameters.fidelity != Fidelity::Draft && result.stopReason == StopReason::Vertices &&
    result.finish && !result.surface.isOpen(request.executor) &&
    std::ranges::any_of(result.warnings,
      [](const std::string& warning)
      {
        return std::ranges::any_of(
          std::array{ MeshIsCoarse, PartIsMissing, GapIsSpanned, FinerThanNoise },
          [&](WarningTopic topic) { return isAbout(warning, topic); });
      });
}

/// Whether a mesh that was refined beside its creases is better than one that has learnt all its
/// vertices. With as many warnings it has to be closer, as it is less regular and coarser in bends.
/// With fewer it wins a draw; with more it loses: the coarser mesh may have lost thin or small parts.
/// With more slivers it has to be clearly closer.
bool isBetterRefined(const Reconstruction& refined, const Reconstruction& learnt)
{
  if (!refined.finish || !refined.quality || !learnt.quality ||
    refined.finish->left.total() > learnt.finish->left.total() ||
    refined.warnings.size() > learnt.warnings.size())
  {
    return false;
  }
  const SurfaceReport& surface = refined.quality->surface;
  const bool hasMoreSlivers = surface.slivers > learnt.quality->surface.slivers &&
    double(surface.slivers) > FewSlivers * double(surface.triangles);
  const double times = hasMoreSlivers                  ? 1. / TimesOfDraw
    : refined.warnings.size() < learnt.warnings.size() ? TimesOfDraw
                                                       : 1.;
  return isCloser(refined, learnt, learnt.surface.vertexCount(), times);
}
}

Parameters learnable(Parameters parameters, const PointCloud& cloud)
{
  if (parameters.fitRounds > 0)
  {
    parameters.numberOfVertices = std::min<std::uint64_t>(
      parameters.numberOfVertices, std::max(LeastLearnt, cloud.differentCount() / PointsPerVertex));
  }
  return parameters;
}

std::size_t firstVertices(std::uint64_t vertices, Fidelity fidelity)
{
  const std::uint64_t shown = fidelity == Fidelity::Draft ? FirstOfDraft : LeastForShape;
  return std::size_t(std::max(vertices / 8, std::min(vertices / 2, shown)));
}

std::uint64_t usualPoints(std::uint64_t vertices)
{
  constexpr std::uint64_t PointsPerVertex = 50;
  constexpr std::uint64_t FewestPoints = 1000000;
  return std::max(FewestPoints, PointsPerVertex * vertices);
}

std::uint64_t verticesToLearn(const RunRequest& request)
{
  const std::uint64_t asked = request.parameters.numberOfVertices;
  const std::uint64_t least =
    std::min<std::uint64_t>(LeastLearntToFit, request.cloud.differentCount() / PointsToSimplify);
  return mayLearnOtherwise(request) ? std::max(asked, least) : asked;
}

Reconstruction betterOf(Reconstruction first, Reconstruction other,
  const std::function<bool(const Reconstruction&, const Reconstruction&)>& isBetter)
{
  other.resumedIterations = first.resumedIterations;
  other.times.add(first.times);
  first.times = other.times;
  const bool isTaken = other.stopReason == StopReason::Cancelled || isBetter(other, first);
  return isTaken ? other : first;
}

bool mayHaveLostThinParts(const Reconstruction& result, const RunRequest& request)
{
  if (!mayLearnOtherwise(request) || request.parameters.fidelity == Fidelity::Draft ||
    result.stopReason != StopReason::Vertices || !result.finish || !result.explanation ||
    !result.quality)
  {
    return false;
  }
  const double meanEdge = result.explanation->asked.meanEdge * request.cloud.unit();
  return result.finish->left.intersectingTriangles > 0 || result.quality->surface.foldedEdges > 0 ||
    result.explanation->torn.any() ||
    !std::ranges::all_of(result.explanation->pieces,
      [meanEdge](const MissedPiece& piece) { return piece.isCoarse(meanEdge); });
}

bool holdsMore(const Reconstruction& finer, const Reconstruction& other)
{
  return holdsMore(finer, other, finer.warnings.size(), other.warnings.size());
}

Reconstruction betterRun(Reconstruction result, const RunRequest& request, const Progress& progress)
{
  const std::uint64_t asked = request.parameters.numberOfVertices;
  if (!mayLearnOtherwise(request) || !result.isComplete())
  {
    return result;
  }
  if (asked < verticesToLearn(request))
  {
    return isRight(result, asked)
      ? result
      : betterOf(std::move(result), learnAndFinish(asked, request, progress, {}, {}),
          [&](const Reconstruction& other, const Reconstruction& first)
          { return !isCloser(first, other, asked); });
  }
  if (!mayHaveRoundedCreases(result, request))
  {
    return result;
  }
  const std::uint64_t fewer = request.cloud.differentCount() / PointsThatTellCreases;
  return betterOf(
    std::move(result), learnAndFinish(fewer, request, progress, {}, {}), isBetterRefined);
}

Reconstruction runWithThinParts(
  Reconstruction result, const RunRequest& request, const Progress& progress, LearntRun* made)
{
  const std::uint64_t asked = request.parameters.numberOfVertices;
  const std::uint64_t finer =
    std::min({ std::max(LearntForThinParts, TimesForThinParts * asked), MostLearntForThinParts,
      std::uint64_t(request.cloud.differentCount() / PointsToHoldThinParts) });
  if (asked >= finer || !mayHaveLostThinParts(result, request))
  {
    return result;
  }
  std::optional<LearntRun> madeFiner;
  const auto keep = [&madeFiner](const LearntRun& run) { madeFiner.emplace(run); };
  Reconstruction other = learnAndFinish(
    finer, request, progress, {}, {}, made ? std::function<void(const LearntRun&)>(keep) : nullptr);
  const auto isTaken = [&](const Reconstruction& second, const Reconstruction& first)
  {
    const bool holds = holdsMore(second, first);
    if (holds && madeFiner)
    {
      // The rules belong to the run.
      made->result = std::move(madeFiner->result);
      made->learnt = std::move(madeFiner->learnt);
      made->vertices = madeFiner->vertices;
      made->gaps = madeFiner->gaps;
    }
    return holds;
  };
  return betterOf(std::move(result), std::move(other), isTaken);
}

Reconstruction runWithNarrowHoles(
  Reconstruction result, const RunRequest& request, const Progress& progress)
{
  if (!mayHaveFilledHoles(result, request))
  {
    return result;
  }
  const std::uint64_t vertices = verticesToLearn(request);
  PhaseTimes times;
  times.enter(Phase::Start);
  Run run(request, progress);
  std::optional<Beginning> beginning = run.beginWithNarrowParts(vertices, { 0., StartOfLearning });
  times.leave();
  // With as many handles, it may reach the edge of a wedge that the grid has cut off.
  const long least = genusOf(result.surface) +
    (std::ranges::any_of(result.warnings,
       [](const std::string& warning) { return isAbout(warning, WarningTopic::PartIsMissing); })
        ? 0
        : 1);
  if (!beginning || genusOf(*beginning->mesh) < least)
  {
    result.times.add(times);
    if (!progress(1.))
    {
      result.stopReason = StopReason::Cancelled;
    }
    return result;
  }
  Checkpoint checkpoint({}, request.cloud, request.parameters);
  return betterOf(std::move(result),
    learnAndFinish(run, vertices, std::move(*beginning), times, request, checkpoint, {}),
    holdsMoreWithHoles);
}

Reconstruction withFurtherRuns(
  Reconstruction result, const RunRequest& request, const Progress& progress)
{
  const Progress better = partOf(progress, 0., EndOfBetterRun),
                 thin = partOf(progress, EndOfBetterRun, EndOfThinParts),
                 holes = partOf(progress, EndOfThinParts, 1.);
  return runWithNarrowHoles(
    runWithThinParts(betterRun(std::move(result), request, better), request, thin), request, holes);
}

double partOfFirstRun(const Parameters& parameters, bool hasFirstMesh)
{
  const bool isLast = hasFirstMesh || !mayLearnOtherwise(parameters) ||
    (parameters.fidelity == Fidelity::Draft && parameters.numberOfVertices >= LeastLearntToFit);
  return isLast ? 1. : PartIfOthersMayFollow;
}

Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first, const GrowthWatch& watch,
  const CheckpointPlan& plan, const Executor& executor, const OrientationHints& hints,
  bool explainsAll)
{
  const RunRequest request{ cloud, parameters, first, executor, hints, explainsAll };
  const double end = partOfFirstRun(parameters, first.has_value());
  const Progress told = rising(progress);
  const Progress ofFirst = partOf(told, 0., end), ofOthers = partOf(told, end, 1.);
  return withFurtherRuns(
    learnAndFinish(verticesToLearn(request), request, ofFirst, watch, plan), request, ofOthers);
}
}
