// SPDX-License-Identifier: BSD-3-Clause
#include "run/Reconstruction.h"

#include "fit/CreaseRefinement.h"
#include "run/Run.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace neuralmesh
{
namespace
{
/// With less the mesh would follow single points, not the surface.
constexpr std::size_t PointsPerVertex = 2;
constexpr std::size_t LeastLearnt = 100;
/// A mesh of fewer vertices would lose what is narrower than its edges while it learns. So that many are
/// learnt, if there are twenty points for each, and simplified.
constexpr std::uint64_t LeastLearntToFit = 1000;
constexpr std::uint64_t PointsToSimplify = 20;
/// Where a mesh has lost what is thin or narrow, so many are learnt, or twice as many as are asked for, if there are five
/// points for each.
constexpr std::uint64_t LearntForThinParts = 20000;
constexpr std::uint64_t TimesForThinParts = 2;
constexpr std::uint64_t MostLearntForThinParts = 100000;
constexpr std::uint64_t PointsToHoldThinParts = 5;
/// Of all points: a coarse mesh has some beside its bends.
constexpr double LeastDifferenceOfUnexplained = 0.005;
/// Of residuals: a few points at creases make most of them, so they are told no better.
constexpr double TimesOfDraw = 1.2;

/// As reconstruct(), but learns so many vertices, and simplifies or refines the mesh if these are too many or too few.
Reconstruction learnAndFinish(std::uint64_t vertices, const RunRequest& request,
  const Progress& progress, const GrowthWatch& watch, const CheckpointPlan& plan)
{
  const Parameters& parameters = request.parameters;
  Checkpoint checkpoint(plan, request.cloud, parameters);
  PhaseTimes times;
  times.enter(Phase::Start);
  Run run(request, progress);
  const bool startsFromSpace = !request.first && parameters.start == Start::OccupiedSpace;
  const double startOfLearning = startsFromSpace ? StartOfLearning : 0.;
  const double endOfLearning = parameters.fitRounds > 0 ? EndOfLearning : 1.;
  Beginning beginning = run.begin(vertices, { 0., startOfLearning });
  times.leave();
  LearntRun learnt = run.learn(
    vertices, std::move(beginning), { startOfLearning, endOfLearning }, checkpoint, watch);
  Reconstruction result =
    run.finish(std::move(learnt), parameters.numberOfVertices, { endOfLearning, 1. });
  result.times.add(times);
  return result;
}

/// Not from a first mesh, nor where rules end the run that are meant for the mesh as it learns.
bool mayLearnOtherwise(const RunRequest& request)
{
  const Parameters& parameters = request.parameters;
  return !request.first && parameters.fitRounds > 0 && !parameters.topologyLearning &&
    !mayEndBeforeVertices(parameters);
}

/// Handles and pieces may need more vertices than there are to be, or so many that the rest is too coarse, and
/// where many stop growing, few may not.
bool isRight(const Reconstruction& simplified, std::uint64_t vertices)
{
  return simplified.stopReason == StopReason::Vertices &&
    simplified.surface.vertexCount() == vertices && simplified.finish &&
    simplified.finish->left.total() == 0;
}

/// Whether there are fewer points a vertex than tell creases, of which the mesh has some, and they may come out
/// sharper on a coarser one.
bool mayHaveRoundedCreases(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters)
{
  return result.stopReason == StopReason::Vertices && result.finish && result.finish->isClean &&
    parameters.fidelity != Fidelity::Draft && parameters.fitSmoothness == 0. &&
    !parameters.computeFeatureStrength &&
    result.surface.vertexCount() > cloud.differentCount() / PointsThatTellCreases &&
    hasCreases(result.surface);
}

/// Whether the first mesh has so many vertices, and a residual smaller than that of the second so many times.
bool isCloser(const Reconstruction& first, const Reconstruction& second, std::uint64_t vertices,
  double times = 1.)
{
  return first.surface.vertexCount() == vertices && first.quality && second.quality &&
    first.quality->residual < times * second.quality->residual;
}

/// Of a mesh that was refined beside its creases, and one that has learnt all of its vertices: whether the first is
/// to be taken. Few of the points that tell it lie at creases, so a draw goes to that; not where it has more slivers, or
/// more to be warned of: parts that are thin or small may be lost on a coarser mesh.
bool isBetterRefined(const Reconstruction& refined, const Reconstruction& learnt)
{
  if (!refined.finish || !refined.quality || !learnt.quality ||
    refined.finish->left.total() > learnt.finish->left.total() ||
    refined.warnings.size() > learnt.warnings.size())
  {
    return false;
  }
  const bool hasMoreSlivers = refined.quality->surface.slivers > learnt.quality->surface.slivers;
  return isCloser(
    refined, learnt, learnt.surface.vertexCount(), hasMoreSlivers ? 1. / TimesOfDraw : TimesOfDraw);
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

std::size_t firstVertices(std::uint64_t vertices)
{
  return std::size_t(std::max(vertices / 8, std::min<std::uint64_t>(vertices / 2, 1500)));
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
  if (finer.stopReason != StopReason::Vertices || !finer.finish || !finer.explanation ||
    finer.surface.vertexCount() != other.surface.vertexCount() ||
    finer.finish->left.total() > other.finish->left.total() ||
    finer.explanation->unexplainedShare() >
      other.explanation->unexplainedShare() + LeastDifferenceOfUnexplained)
  {
    return false;
  }
  return finer.warnings.size() < other.warnings.size() ||
    (finer.warnings.size() == other.warnings.size() &&
      isCloser(finer, other, other.surface.vertexCount()));
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
  if (!mayHaveRoundedCreases(result, request.cloud, request.parameters))
  {
    return result;
  }
  const std::uint64_t fewer = request.cloud.differentCount() / PointsThatTellCreases;
  return betterOf(
    std::move(result), learnAndFinish(fewer, request, progress, {}, {}), isBetterRefined);
}

Reconstruction runWithThinParts(
  Reconstruction result, const RunRequest& request, const Progress& progress)
{
  const std::uint64_t asked = request.parameters.numberOfVertices;
  const std::uint64_t finer =
    std::min({ std::max(LearntForThinParts, TimesForThinParts * asked), MostLearntForThinParts,
      std::uint64_t(request.cloud.differentCount() / PointsToHoldThinParts) });
  if (asked >= finer || !mayHaveLostThinParts(result, request))
  {
    return result;
  }
  return betterOf(std::move(result), learnAndFinish(finer, request, progress, {}, {}), holdsMore);
}

Reconstruction reconstruct(const PointCloud& cloud, const Parameters& parameters,
  const Progress& progress, const std::optional<Mesh>& first, const GrowthWatch& watch,
  const CheckpointPlan& plan, const Executor& executor, const OrientationHints& hints,
  bool explainsAll)
{
  const RunRequest request{ cloud, parameters, first, executor, hints, explainsAll };
  const Progress atTheEnd = partOf(progress, 1., 1.);
  return runWithThinParts(
    betterRun(
      learnAndFinish(verticesToLearn(request), request, progress, watch, plan), request, atTheEnd),
    request, atTheEnd);
}
}
