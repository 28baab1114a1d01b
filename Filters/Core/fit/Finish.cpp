// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Finish.h"

#include "base/InterruptibleExecutor.h"
#include "fit/CrumpledMesh.h"
#include "fit/FidelityRounds.h"
#include "fit/NarrowBridges.h"
#include "fit/SheetJoints.h"
#include "fit/SliverRepair.h"
#include "fit/TornLoops.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BrokenMoves.h"
#include "mesh/CrossingRemoval.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SmallPieces.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Defects, at most, that are taken away if nothing else helps: so many, or that part of the triangles.
constexpr std::size_t MostTakenAway = 200;
constexpr double MostPartTakenAway = 0.02;
/// Of the time, if more rounds come after them.
constexpr double PartOfFirstRounds = 0.4;
/// Of the time of a round.
constexpr double PartOfPlaces = 0.5;
/// For them.
constexpr double LeastSamplesPerVertex = 1.5;
/// Folds after a round, at most, against the triangles: two share a fold, so 0.5 % of these are folded. The limit is not
/// derived. Clouds without a place denser than its noise have less than a third of it, a scanned room eight times of it.
/// A repair mends a few folds without a loss, however small the mesh is.
constexpr double MostPartFolded = 0.0025;
constexpr std::size_t FewFolds = 32;
/// Of the residual of a surface: what it may cost to mend intersections, and slivers.
constexpr double MostGrownByRepair = 0.1;
/// Of the variance of the noise, what its parts have by chance, and as the finished mesh follows some of the noise.
constexpr double MostVarianceTold = 2.;
/// A piece with less than this part of the area has shrunk to a point.
constexpr double ShrunkPart = 1e-14;
/// ... however many vertices it has.
constexpr double AnyVertices = 1.;

DefectCount countDefects(const Mesh& mesh, const Executor& executor)
{
  return { intersectingTriangles(mesh, executor).size(), foldedEdges(mesh, executor).size() };
}

/// Whether parts are those of more than all noise that the finished mesh tells: they are told on a smoother one, which
/// may miss ripples. Those look like layers. Half of what two views share is about their mean.
bool isMore(const NoiseParts& parts, double noise)
{
  return parts.own * parts.own + 0.5 * parts.shared * parts.shared >
    MostVarianceTold * noise * noise;
}

VertexIndex nearestToCollapseInto(const Mesh& mesh, VertexIndex v)
{
  VertexIndex nearest = NoVertex;
  float shortest = std::numeric_limits<float>::max();
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    const float squared = squaredNorm(mesh.position(neighbor) - mesh.position(v));
    if (squared < shortest && mesh.canCollapse(v, neighbor))
    {
      shortest = squared;
      nearest = neighbor;
    }
  }
  return nearest;
}
}

Finish::Finish(const PointCloud& cloud, Mesh& mesh, const FinishPlan& plan,
  const Executor& executor, PointNormals normalOf, PointViews viewOf)
  : cloud_(cloud)
  , mesh_(mesh)
  , plan_(plan)
  , executor_(executor)
  , normalOf_(std::move(normalOf))
  , viewOf_(std::move(viewOf))
{
}

bool Finish::run(const Progress& progress)
{
  const StoredMesh before(mesh_, executor_.uninterrupted());
  try
  {
    return runAll(before, progress);
  }
  catch (const Interrupted&)
  {
    mesh_ = before.mesh(executor_);
    return false;
  }
}

bool Finish::runAll(const StoredMesh& before, const Progress& progress)
{
  FitGuard guard(cloud_, mesh_, executor_, plan_.residualTo);
  if (!progress(0.) || !runRounds(plan_.rounds, guard, progress))
  {
    return false;
  }
  const Progress untilLater = partOf(progress, 1., 1.);
  // Those of the fidelity are taken back first, all together.
  const bool hadMore = plan_.rounds > 0 && report_.fidelityRounds > 0;
  const int most = plan_.rounds + report_.fidelityRounds;
  for (int rounds = plan_.rounds - (hadMore ? 0 : 1); rounds >= 0 && isWorseThan(before, guard);
       --rounds)
  {
    mesh_ = before.mesh(executor_);
    report_ = FinishReport{};
    report_.roundsTakenBack = most - rounds;
    plan_.fidelity = Fidelity::Draft;
    if (!runRounds(rounds, guard, untilLater))
    {
      return false;
    }
  }
  return true;
}

/// Whether the mesh is, as it is finished now, against what it was at first.
bool Finish::isWorseThan(const StoredMesh& before, FitGuard& guard) const
{
  // Whoever asks for a smoothness gets it.
  const ResidualRule rule = plan_.smoothness > 0. ? ResidualRule::MayGrow
    : report_.isClean                             ? ResidualRule::MayNotGrow
                                                  : ResidualRule::MayBeNoise;
  // Of a surface no point is lost: all count in the residual.
  if (plan_.surface ? guard.hasGrown(before.mesh(executor_), mesh_, 0.)
                    : guard.isWorse(mesh_, rule, report_.repaired.total() > 0))
  {
    return true;
  }
  return report_.left.intersectingTriangles > 0 &&
    double(report_.left.intersectingTriangles) / double(mesh_.vertexCount()) >
    double(intersectingTriangles(before.mesh(executor_), executor_).size()) /
      double(before.vertexCount());
}

/// So many rounds of the fit, and what goes with them.
bool Finish::runRounds(int rounds, FitGuard& guard, const Progress& report)
{
  staysUnbroken_ = isUnbroken_ = false;
  const auto samples = std::size_t(plan_.samplesPerVertex * double(plan_.vertexCount));
  // With fewer samples, more rounds would follow single ones.
  const bool areEnough = double(std::min(samples, cloud_.points().size())) >
    LeastSamplesPerVertex * double(plan_.vertexCount);
  const bool hasMore = rounds > 0 && areEnough && plan_.fidelity != Fidelity::Draft;
  // A surface that is close already would only be smoothed by the first ones.
  const int firstRounds = plan_.surface ? 0 : rounds;
  const double endOfFirst = !hasMore ? 1. : firstRounds > 0 ? PartOfFirstRounds : 0.;
  const Progress progress = partOf(report, 0., endOfFirst);
  if (plan_.tellsSmoothness)
  {
    report_.smoothnessOfVertices = mesh_.addProperty(0.f, OnSplit::Copy);
  }
  std::optional<SurfaceFit> surfaceFit;
  const auto beginAnew = [&]
  {
    surfaceFit.emplace(cloud_, mesh_, samples, executor_, normalOf_, viewOf_);
    if (plan_.searchesNear)
    {
      surfaceFit->searchNear();
    }
    if (plan_.surface)
    {
      surfaceFit->keepTo(*plan_.surface);
      surfaceFit->keepBoundaries();
    }
    if (report_.smoothnessOfVertices)
    {
      surfaceFit->tellSmoothness(*report_.smoothnessOfVertices);
    }
  };
  const auto refineAll = [&](double at)
  {
    if (!refine(mesh_, plan_.vertexCount, partOf(progress, at, at)))
    {
      // What was refined until a run ends is kept.
      return false;
    }
    flipEdges(mesh_, EdgesToFlip::All, executor_);
    return true;
  };
  if (rounds == 0 && mesh_.vertexCount() < plan_.vertexCount && !refineAll(0.))
  {
    return false;
  }
  if (firstRounds > 0)
  {
    // On a crumpled mesh, noise looks like shape.
    smoothCrumpledMesh(mesh_, cloud_, executor_);
  }
  beginAnew();
  double smoothness = plan_.smoothness;
  if (plan_.surface)
  {
    report_.isClean = true;
    report_.smoothness = smoothness > 0. ? smoothness : SurfaceFit::LeastSmoothness;
  }
  for (int round = 0; round < firstRounds; ++round)
  {
    const bool isLast = round + 1 == firstRounds;
    if (isLast && mesh_.vertexCount() < plan_.vertexCount)
    {
      if (!refineAll(double(round) / rounds))
      {
        return false;
      }
      beginAnew();
    }
    const Progress part = partOf(progress, double(round) / rounds, double(round + 1) / rounds);
    if (!surfaceFit->findPlaces(partOf(part, 0., PartOfPlaces)))
    {
      return false;
    }
    if (isLast && cutJoints(*surfaceFit))
    {
      beginAnew();
      if (!surfaceFit->findPlaces(partOf(part, PartOfPlaces, PartOfPlaces)))
      {
        return false;
      }
    }
    if (isLast && fillTornLoops(mesh_, surfaceFit->places()) > 0)
    {
      flipEdges(mesh_, EdgesToFlip::All, executor_);
      beginAnew();
      if (!surfaceFit->findPlaces(partOf(part, PartOfPlaces, PartOfPlaces)))
      {
        return false;
      }
    }
    if (isLast && round > 0)
    {
      if (trimOutlines(*surfaceFit))
      {
        flipEdges(mesh_, EdgesToFlip::All, executor_);
        beginAnew();
        if (!surfaceFit->findPlaces(partOf(part, PartOfPlaces, PartOfPlaces)))
        {
          return false;
        }
      }
      surfaceFit->reachTheEnd();
    }
    if (!move(*surfaceFit, smoothness, partOf(part, PartOfPlaces, 1.)))
    {
      return false;
    }
    if (isLast)
    {
      report_.shareBetweenLayers = surfaceFit->shareBetweenLayers();
      if (!report_.isClean && !hasMore)
      {
        tell(surfaceFit->noiseParts());
      }
    }
    if (round == 0)
    {
      smoothness = report_.smoothness;
      const bool isOpened = plan_.gaps && openGaps(*surfaceFit, false);
      if (closeHoles() || isOpened)
      {
        beginAnew();
      }
      if (!part(1.))
      {
        return false;
      }
      // A fitted surface is smoother than the learnt one, and lets more edges be flipped.
      flipEdges(mesh_, EdgesToFlip::All, executor_);
    }
    if (!part(1.))
    {
      return false;
    }
  }
  if (hasMore && !improve(*surfaceFit, partOf(report, endOfFirst, 1.)))
  {
    return false;
  }
  if (!plan_.surface)
  {
    isUnbroken_ = fillCracks(mesh_) == 0 && isUnbroken_;
  }
  if (!repair(*surfaceFit, guard, partOf(report, 1., 1.)) || !report(1.))
  {
    return false;
  }
  surfaceFit.reset();
  dropOddPieces();
  if (!report(1.))
  {
    return false;
  }
  const StoredMesh withSlivers(mesh_, executor_);
  repairSlivers(mesh_, guard, executor_);
  if (plan_.surface)
  {
    Mesh before = withSlivers.mesh(executor_);
    if (guard.hasGrown(before, mesh_, MostGrownByRepair))
    {
      mesh_ = std::move(before);
    }
    return report(1.);
  }
  return mendWithoutSlivers(guard, report);
}

/// Slivers may have kept a defect from being mended.
bool Finish::mendWithoutSlivers(FitGuard& guard, const Progress& progress)
{
  if (report_.left.total() > 0)
  {
    report_.left = countDefects(mesh_, executor_);
  }
  while (
    progress(1.) && mendsBy([this] { collapseDefects(); }, MayLose::SomePoints, guard, progress))
  {
    repairSlivers(mesh_, guard, executor_);
  }
  return progress(1.);
}

/// Where no sample has its place on a piece, nothing keeps the fit and the repair from shrinking that to a
/// point. A few triangles that came off the rest lie beside it, and show nothing. Both stay where their vertices cannot
/// come in again: nothing is left that is not as thin.
void Finish::dropOddPieces()
{
  const StoredMesh before(mesh_, executor_);
  const std::size_t shrunk = dropPieces(mesh_, ShrunkPart, AnyVertices, executor_);
  const std::size_t scraps = plan_.surface ? 0 : dropScraps(mesh_, executor_);
  if (shrunk + scraps > 0)
  {
    refine(
      mesh_, before.vertexCount(), [](double) { return true; }, EdgesAfterSplit::Keep);
    if (mesh_.vertexCount() != before.vertexCount())
    {
      mesh_ = before.mesh(executor_);
    }
    report_.left = countDefects(mesh_, executor_);
  }
}

/// Where the repair would lose samples, it stays as it was, broken or not. Returns false if it was ended
/// before that was known.
bool Finish::repair(SurfaceFit& surfaceFit, FitGuard& guard, const Progress& progress)
{
  if (!progress(1.))
  {
    return false;
  }
  const StoredMesh before(mesh_, executor_);
  const IntersectionRepair repair =
    isUnbroken_ ? IntersectionRepair() : repairIntersections(mesh_, progress, executor_);
  report_.repaired = repair.before;
  report_.left = repair.after;
  if (!progress(1.))
  {
    return false;
  }
  if (plan_.surface)
  {
    // One that cuts itself may have to stay so.
    Mesh cut = before.mesh(executor_);
    if (repair.before.total() > 0 && guard.hasGrown(cut, mesh_, MostGrownByRepair))
    {
      mesh_ = std::move(cut);
      report_.left = repair.before;
    }
    return true;
  }
  if (repair.before.total() > 0 && guard.losesPoints(mesh_, true))
  {
    Mesh broken = before.mesh(executor_);
    if (!surfaceFit.hasPlaces())
    {
      std::swap(mesh_, broken);
      const bool isDone = surfaceFit.findPlaces(progress);
      std::swap(mesh_, broken);
      if (!isDone)
      {
        return false;
      }
    }
    report_.heldVertices += surfaceFit.holdAgainst(broken);
    report_.left = countDefects(mesh_, executor_);
  }
  // A mesh that is open anyway may have a small hole more. That loses fewer points than a collapse where these are
  // dense.
  const bool isOpen = mesh_.isOpen(executor_);
  const auto collapse = [this] { collapseDefects(); };
  while (mendsBy(collapse, isOpen ? MayLose::NoPoints : MayLose::SomePoints, guard, progress))
  {
  }
  while (isOpen &&
    mendsBy([this] { replaceFewestCrossings(mesh_); }, MayLose::SomePoints, guard, progress))
  {
  }
  while (isOpen && report_.left.intersectingTriangles > 0 &&
    mendsBy(collapse, MayLose::SomePoints, guard, progress))
  {
  }
  return true;
}

/// Takes away by `remove` some of what is broken. Where no less is broken then, or points are lost, the
/// mesh stays as it was, and the answer is no.
template <typename Remove>
bool Finish::mendsBy(
  const Remove& remove, MayLose mayLose, FitGuard& guard, const Progress& progress)
{
  const auto most = std::size_t(MostPartTakenAway * double(mesh_.triangleCount()));
  if (report_.left.total() == 0 || report_.left.total() > std::max(MostTakenAway, most))
  {
    return false;
  }
  const StoredMesh before(mesh_, executor_);
  const bool wasWorse = guard.losesPoints(mesh_, true);
  remove();
  // As many vertices come in again where edges are long.
  mesh_.dropErased(executor_);
  refine(
    mesh_, before.vertexCount(), [](double) { return true; }, EdgesAfterSplit::Keep);
  const IntersectionRepair again = repairIntersections(mesh_, progress, executor_);
  if (again.after.total() >= report_.left.total() || mesh_.vertexCount() != before.vertexCount() ||
    (!wasWorse && guard.losesPoints(mesh_, true)) ||
    (mayLose == MayLose::NoPoints && guard.losesDensePoints(before.mesh(executor_), mesh_)))
  {
    mesh_ = before.mesh(executor_);
    return false;
  }
  report_.left = again.after;
  return true;
}

/// Each vertex of a defect goes into its nearest neighbour.
void Finish::collapseDefects()
{
  for (const VertexIndex v : brokenVertices(mesh_, std::vector<bool>(mesh_.indexEnd(), true)))
  {
    if (mesh_.isAlive(v))
    {
      const VertexIndex kept = nearestToCollapseInto(mesh_, v);
      if (kept != NoVertex)
      {
        mesh_.collapse(v, kept);
      }
    }
  }
}

/// More than a repair in the end can mend without a loss, as where points are closer together than their noise.
bool Finish::isMuchFolded() const
{
  const std::size_t folds = foldedEdges(mesh_, executor_).size();
  return folds > FewFolds && double(folds) > MostPartFolded * double(mesh_.triangleCount());
}

/// Where a round folds much, vertices stay where they would break the mesh. Otherwise the repair loses points, and all
/// rounds are taken back because of one place.
bool Finish::move(SurfaceFit& surfaceFit, double smoothness, const Progress& progress)
{
  PackedVectors before;
  if (!surfaceFit.moveVertices(smoothness, progress, before))
  {
    return false;
  }
  staysUnbroken_ = staysUnbroken_ || isMuchFolded();
  if (staysUnbroken_ &&
    takeBackBrokenMoves(mesh_, before, partOf(progress, 1., 1.), executor_) ==
      AfterBrokenMoves::Cancelled)
  {
    return false;
  }
  report_.noise = surfaceFit.noise();
  report_.smoothness = surfaceFit.smoothness();
  report_.isClean = surfaceFit.isClean();
  report_.outlierShare = surfaceFit.outlierShare();
  report_.heldVertices += surfaceFit.heldCount();
  return true;
}

void Finish::tell(const NoiseParts& parts)
{
  report_.ownNoise = parts.own;
  report_.sharedNoise = parts.shared;
}

/// The rounds that come after the first ones.
bool Finish::improve(SurfaceFit& surfaceFit, const Progress& progress)
{
  report_.fidelityRounds =
    std::min(plan_.mostFidelityRounds, FidelityRounds::count(plan_.fidelity, report_.isClean));
  FidelityRounds rounds(mesh_, surfaceFit, plan_.vertexCount, plan_.keepsPlaces, executor_);
  if (staysUnbroken_)
  {
    rounds.stayUnbroken();
  }
  if (!rounds.run(plan_.fidelity, report_.fidelityRounds, report_.isClean, plan_.smoothness > 0.,
        report_.smoothness, progress))
  {
    return false;
  }
  isUnbroken_ = rounds.isUnbroken();
  report_.noise = surfaceFit.noise();
  report_.smoothness = rounds.lambda();
  report_.outlierShare = surfaceFit.outlierShare();
  tell(isMore(rounds.noiseParts(), report_.noise) ? NoiseParts{ report_.noise, 0. }
                                                  : rounds.noiseParts());
  report_.heldVertices += rounds.heldVertices();
  report_.shareBetweenLayers = surfaceFit.shareBetweenLayers();
  return true;
}

/// Gaps are looked for once more: samples that lay on what was left over at an outline have their places elsewhere by
/// now. What was closed would be opened.
bool Finish::trimOutlines(const SurfaceFit& surfaceFit)
{
  if (!plan_.gaps || plan_.closedOutline > 0. || !mesh_.isOpen(executor_))
  {
    return false;
  }
  const std::size_t count = mesh_.vertexCount();
  const bool isOpened = openGaps(surfaceFit, true);
  const std::size_t bridges = cutNarrowBridges(
    cloud_, mesh_, surfaceFit.places().size(), surfaceFit.medianDistance(), executor_);
  if (bridges > 0)
  {
    report_.gapTriangles += bridges;
    mesh_.dropErased(executor_);
    refine(mesh_, count, [](double) { return true; });
  }
  return isOpened || bridges > 0;
}

bool Finish::closeHoles()
{
  if (!(plan_.closedOutline > 0.))
  {
    return false;
  }
  BoundaryManager boundaries(mesh_);
  return fillShortBoundaries(mesh_, boundaries, plan_.closedOutline) > 0;
}

/// Sheets are told apart by now: vertices lie on the points.
bool Finish::cutJoints(const SurfaceFit& surfaceFit)
{
  const std::size_t count = mesh_.vertexCount();
  if (cutSheetJoints(mesh_, surfaceFit.places(), surfaceFit.medianDistance(), executor_) == 0)
  {
    return false;
  }
  mesh_.dropErased(executor_);
  refine(mesh_, count, [](double) { return true; });
  flipEdges(mesh_, EdgesToFlip::All, executor_);
  return true;
}

bool Finish::openGaps(const SurfaceFit& surfaceFit, bool mustBeFar)
{
  const std::size_t count = mesh_.vertexCount();
  GapPlan plan = *plan_.gaps;
  plan.rules.mustBeFar = mustBeFar;
  const OpenedGaps gaps =
    openDataGaps(cloud_, mesh_, surfaceFit.places(), surfaceFit.medianDistance(), plan, executor_);
  if (!gaps.any())
  {
    return false;
  }
  report_.gapTriangles += gaps.triangles;
  mesh_.dropErased(executor_);
  refine(mesh_, count, [](double) { return true; });
  return true;
}
}
