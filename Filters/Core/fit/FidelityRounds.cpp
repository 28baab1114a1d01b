// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FidelityRounds.h"

#include "fit/BareFolds.h"
#include "fit/CreaseRefinement.h"
#include "fit/CreaseSnapping.h"
#include "fit/CutCorners.h"
#include "fit/DataFlips.h"
#include "fit/IntersectionRepair.h"
#include "fit/Redistribution.h"
#include "mesh/BrokenMoves.h"
#include "mesh/Refinement.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
struct RoundsOf
{
  int clean;
  int distributing; ///< of the clean ones, the first
  int noisy;
};

RoundsOf roundsOf(Fidelity fidelity)
{
  switch (fidelity)
  {
    case Fidelity::Draft:
      return { 0, 0, 0 };
    case Fidelity::High:
      return { 10, 6, 2 };
    default:
      return { 4, 3, 2 };
  }
}

/// The part of the vertices, at most, that a round takes to other places.
constexpr double MostDistributed = 0.1;
/// The part, at most, that corners get in the end.
constexpr double MostAddedAtCorners = 0.05;
/// Of lambda, on a clean cloud: creases no longer need so much of it.
constexpr double PartOnCleanClouds = 0.5;
/// Of that, at least, in rounds that come near enough to measure it again. Less makes triangles uneven.
constexpr double LeastPartOfSettled = 0.5;
/// Beyond so many deviations of the usual bend it is a crease.
constexpr double DeviationsOfCreaseIfClean = 2.;
/// The mesh on which places are found first is so much smoother than that of the rounds before, but its lambda is at
/// least that, and at most the one for which each place of it follows so many samples ...
constexpr double FirstTimesSmoother = 2.;
constexpr double LeastFirstLambda = 50.;
constexpr double MostFollowed = 60.;
/// Where noise is large against edges, samples slide along what the mesh has followed of it, and lambda is then chosen so
/// that it follows them again. So lambda is larger there, up to that limit: the square of the noise in such parts of an
/// edge ...
constexpr double MostFirstBend = 0.03;
/// ... and so much smoother than the one that comes out, later.
constexpr double TimesSmoother = 2.;
/// What comes out bends over no fewer deviations of the noise: samples would have their places on the wrong side of a bend.
constexpr double LeastDeviationsOfBend = 1.2;
}

int FidelityRounds::count(Fidelity fidelity, bool isClean)
{
  const RoundsOf rounds = roundsOf(fidelity);
  return isClean ? rounds.clean : rounds.noisy;
}

bool FidelityRounds::run(Fidelity fidelity, int rounds, bool isClean, bool isFixed, double lambda,
  const Progress& progress)
{
  lambda_ = lambda * (isClean && !isFixed ? PartOnCleanClouds : 1.);
  least_ = lambda_ * (fidelity == Fidelity::High && !isFixed ? LeastPartOfSettled : 1.);
  fit_.findExactly();
  fit_.keepBoundaries();
  if (isClean)
  {
    fit_.settle();
  }
  for (int round = 0; round < rounds; ++round)
  {
    const Progress part = partOf(progress, double(round) / rounds, double(round + 1) / rounds);
    const bool isDone = isClean ? sharpen(round < roundsOf(fidelity).distributing, part)
                                : smooth(round == 0, isFixed, part);
    if (!isDone)
    {
      return false;
    }
  }
  if (isClean && rounds > 0 && !keepsPlaces_ && hasCreases(mesh_, executor_) &&
    !sharpenCorners(partOf(progress, 1., 1.)))
  {
    return false;
  }
  if (mesh_.vertexCount() >= vertexCount_)
  {
    return true;
  }
  isUnbroken_ = false;
  // A flip for the sake of shapes would cut off what is sharp now.
  return refine(mesh_, vertexCount_, partOf(progress, 1., 1.),
    isClean ? EdgesAfterSplit::FlipFlat : EdgesAfterSplit::Flip);
}

bool FidelityRounds::sharpen(bool distributes, const Progress& progress)
{
  if (mayBeBroken_ && !staysUnbroken_)
  {
    // As long as a round follows that brings back what it rounds off.
    repairIntersections(mesh_, partOf(progress, 0., 0.), executor_);
  }
  if (!fit_.findPlaces(partOf(progress, 0., 0.3)))
  {
    return false;
  }
  if (!keepsPlaces_)
  {
    if (!distributes && !mesh_.isOpen(executor_))
    {
      fit_.follow(collapseBareFolds(mesh_, fit_.placedSamples(), fit_.variance(), executor_));
    }
    fit_.follow(snapToCreases(mesh_, fit_.placedSamples(), fit_.variance(), executor_));
  }
  if (!progress(0.4))
  {
    return false;
  }
  const std::size_t missing = vertexCount_ - std::min(vertexCount_, mesh_.vertexCount());
  const double most = distributes && !keepsPlaces_ ? MostDistributed : 0.;
  if (most > 0. || missing > 0)
  {
    fit_.follow(
      redistribute(mesh_, fit_.placedSamples(), fit_.variance(), most, missing, executor_));
  }
  if (!progress(0.5))
  {
    return false;
  }
  const ChangedVertices flipped =
    flipToSamples(mesh_, fit_.placedSamples(), fit_.variance(), executor_);
  if (!progress(0.55))
  {
    return false;
  }
  fit_.follow(flipped);
  if (!progress(0.6))
  {
    return false;
  }
  fit_.relaxCreases(DeviationsOfCreaseIfClean);
  if (!distributes)
  {
    // Before, creases are not sharp yet, and tips may come to have more vertices.
    fit_.endWithSamples();
    if (least_ < lambda_)
    {
      lambda_ = std::clamp(fit_.settledSmoothness(), least_, lambda_);
    }
  }
  PackedVectors before;
  if (!move(lambda_, partOf(progress, 0.7, 1.), before))
  {
    return false;
  }
  // What would mend it in the end rounds off creases.
  const AfterBrokenMoves after =
    takeBackBrokenMoves(mesh_, before, partOf(progress, 1., 1.), executor_);
  mayBeBroken_ = after == AfterBrokenMoves::Broken;
  isUnbroken_ = after == AfterBrokenMoves::Untouched;
  return after != AfterBrokenMoves::Cancelled && progress(1.);
}

/// A solution rounds off corners beside which few samples lie. So they get sharp again after the last one. Smooth shapes
/// have next to none, and the search for them costs as much as a round.
bool FidelityRounds::sharpenCorners(const Progress& progress)
{
  isUnbroken_ = false;
  const auto follow = [&](const auto& change)
  {
    fit_.follow(change(mesh_, fit_.placedSamples(), fit_.variance(), executor_));
    return progress(1.);
  };
  // Only a solution moves all places: what is changed at corners moves those around.
  if (!fit_.findPlaces(progress) || !follow(completeCorners) || !follow(snapToCreases) ||
    !follow(completeCorners))
  {
    return false;
  }
  const auto most = std::size_t(MostAddedAtCorners * double(vertexCount_));
  const std::size_t wanted =
    wantedAtCorners(mesh_, fit_.placedSamples(), fit_.variance(), most, executor_);
  if (wanted == 0)
  {
    return true;
  }
  const auto missing = [&] { return vertexCount_ - std::min(vertexCount_, mesh_.vertexCount()); };
  if (wanted > missing())
  {
    fit_.follow(
      removeCheapest(mesh_, fit_.placedSamples(), fit_.variance(), wanted - missing(), executor_));
  }
  fit_.follow(addAtCorners(
    mesh_, fit_.placedSamples(), fit_.variance(), std::min(wanted, missing()), executor_));
  return true;
}

/// Of the mesh on which places are found first on a noisy cloud.
double FidelityRounds::firstLambda() const
{
  const double perVertex = double(fit_.placedSamples().points.size()) / double(mesh_.vertexCount());
  const double bend = fit_.noise() / (MostFirstBend * mesh_.meanEdge(executor_));
  const double most = std::max(FitSystem::smoothnessThatFollows(MostFollowed, perVertex),
    fit_.smoothnessOver(SurfaceFit::FirstDeviationsOfBend, fit_.noise()));
  return std::min(most, std::max({ FirstTimesSmoother * lambda_, LeastFirstLambda, bend * bend }));
}

bool FidelityRounds::smooth(bool isFirst, bool isFixed, const Progress& progress)
{
  const double smoother = !isFirst ? TimesSmoother * lambda_ : isFixed ? lambda_ : firstLambda();
  // Later the places are those for which lambda was chosen.
  if ((isFirst && !fit_.findPlaces(partOf(progress, 0., 0.1))) ||
    !move(smoother, partOf(progress, 0.1, 0.2)) || !fit_.findPlaces(partOf(progress, 0.2, 0.3)))
  {
    return false;
  }
  if (isFirst)
  {
    noiseParts_ = fit_.noiseParts();
  }
  const double variance = fit_.noise() * fit_.noise();
  fit_.shiftAgainstNoise(variance);
  fit_.expectBends(DeviationsOfCreaseIfNoisy);
  fit_.turnToNormals(variance);
  fit_.relaxCreases(DeviationsOfCreaseIfNoisy);
  if (!isFirst || isFixed)
  {
    return move(lambda_, partOf(progress, 0.3, 1.));
  }
  if (!fit_.chooseSmoothnessByRisk(lambda_, partOf(progress, 0.3, 1.)))
  {
    return false;
  }
  lambda_ = std::max(fit_.smoothness(), fit_.smoothnessOver(LeastDeviationsOfBend, fit_.noise()));
  fit_.relaxCreases(DeviationsOfCreaseIfNoisy);
  return true;
}

bool FidelityRounds::move(double lambda, const Progress& progress)
{
  PackedVectors before;
  return move(lambda, progress, before);
}

bool FidelityRounds::move(double lambda, const Progress& progress, PackedVectors& before)
{
  if (!fit_.moveVertices(lambda, progress, before))
  {
    return false;
  }
  heldVertices_ += fit_.heldCount();
  return true;
}
}
