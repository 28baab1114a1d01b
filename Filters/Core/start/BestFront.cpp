// SPDX-License-Identifier: BSD-3-Clause
#include "start/BestFront.h"

#include "mesh/BoundaryManager.h"
#include "mesh/NarrowHandles.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t LeastSamples = 6000;
constexpr std::size_t MostSamples = 14000;
constexpr std::uint64_t SeedOfFront = 1;
/// So many more are tried where two of them show one surface with other handles.
constexpr std::uint64_t FrontsAtOdds = 2;
/// Of the area of the best one before.
constexpr double AreaOfOther = 0.999;
/// See FrontSurface::disorder(): less is a surface without doubt. Where there is no other that is, more
/// will do.
constexpr double MostDisorder = 5.;
constexpr double MostDisorderAtAll = 40.;
/// Share of the samples of a front: of a sheet that has two sides.
constexpr double LeastInTwoLayers = 0.05;
/// Of the area that a front has if it takes those for one sheet, for each of their share: with both sides
/// it has so much more. It may have shown a part of them anyway.
constexpr double LeastOfSecondLayer = 0.25;
/// Of the area of another front, one of the same surface has so much.
constexpr double AreaOfSame = 0.99;
/// A front with both layers may have so many more boundaries.
constexpr std::size_t MostMoreLoops = 2;
/// Of its samples: more lie in no layer where there are outliers in all of space.
constexpr double MostScatter = 0.03;

/// Whether a front shows the two sides of what another one takes for one sheet: then it has more area, and
/// hardly more boundaries. Where views lie beside each other, each layer ends somewhere.
bool showsBothLayers(const FrontSurface& apart, const FrontSurface& joined)
{
  const double least = 1. + LeastOfSecondLayer * joined.inOneOfTwo;
  return joined.inOneOfTwo >= LeastInTwoLayers && apart.disorder() < MostDisorder &&
    areaOf(apart.mesh) >= least * areaOf(joined.mesh) &&
    BoundaryManager(apart.mesh).loopCount() <=
    BoundaryManager(joined.mesh).loopCount() + MostMoreLoops;
}

/// Whether a front with layers apart closes what the other one left open, and is no less in order for that.
bool closesMore(const FrontSurface& apart, const FrontSurface& joined)
{
  return apart.disorder() <= joined.disorder() &&
    areaOf(apart.mesh) >= AreaOfSame * areaOf(joined.mesh) &&
    BoundaryManager(apart.mesh).loopCount() < BoundaryManager(joined.mesh).loopCount();
}

/// Whether two fronts show the same surface.
bool areSame(const FrontSurface& one, const FrontSurface& other)
{
  const double area = areaOf(one.mesh), otherArea = areaOf(other.mesh);
  return one.disorder() < MostDisorder && other.disorder() < MostDisorder &&
    std::min(area, otherArea) >= AreaOfSame * std::max(area, otherArea);
}

/// Whether a front shows the same surface with fewer handles and loops: those of the other one go from one layer to
/// the next.
bool isSimpler(const FrontSurface& front, const FrontSurface& other)
{
  const std::size_t loops = BoundaryManager(front.mesh).loopCount();
  const std::size_t otherLoops = BoundaryManager(other.mesh).loopCount();
  const long genus = genusOf(front.mesh), otherGenus = genusOf(other.mesh);
  return areSame(front, other) && loops <= otherLoops && genus <= otherGenus &&
    (loops < otherLoops || genus < otherGenus);
}

/// Cuts that would make disks of it.
long cutsOf(const FrontSurface& front)
{
  return 2 * genusOf(front.mesh) + long(BoundaryManager(front.mesh).loopCount()) +
    long(pieceCount(front.mesh));
}

/// Whether a front goes on to the edge of a wedge, where another one has handles that lead from one side to the other:
/// that one has less area, as there is one layer of samples between them.
bool showsEdge(const FrontSurface& front, const FrontSurface& other)
{
  return genusOf(front.mesh) < genusOf(other.mesh) && cutsOf(front) < cutsOf(other) &&
    areaOf(front.mesh) >= AreaOfOther * areaOf(other.mesh) &&
    findNarrowHandles(other.mesh).count > 0;
}

/// Whether handles of a front may have come by chance: that makes narrow ones, and tears.
bool isInDoubt(const FrontSurface& front)
{
  return genusOf(front.mesh) > 0 &&
    (BoundaryManager(front.mesh).loopCount() > 0 || findNarrowHandles(front.mesh).count > 0);
}

/// Whether an edge is told by too few samples to be closed, or in order.
bool isTorn(const FrontSurface& front)
{
  return front.disorder() >= MostDisorder || BoundaryManager(front.mesh).loopCount() > 0 ||
    pieceCount(front.mesh) > 1;
}

bool isLessTorn(const FrontSurface& front, const FrontSurface& other)
{
  const long difference = cutsOf(front) - cutsOf(other);
  return genusOf(front.mesh) <= genusOf(other.mesh) &&
    (difference < 0 || (difference == 0 && front.disorder() < other.disorder()));
}
}

bool isCertain(const FrontSurface& front)
{
  return front.disorder() < MostDisorder && front.scatter < MostScatter;
}

std::optional<FrontSurface> bestFront(const FrontMaker& frontOf)
{
  std::optional<FrontSurface> best = frontOf(Layers::Joined, SeedOfFront, 0., 0.5);
  const bool isWithoutDoubt =
    best && best->disorder() < MostDisorder && best->inOneOfTwo < LeastInTwoLayers;
  auto apart = isWithoutDoubt ? std::nullopt : frontOf(Layers::Apart, SeedOfFront, 0.5, 0.75);
  const bool isOfEdge = best && apart && showsEdge(*apart, *best);
  const bool areAtOdds =
    best && apart && (isOfEdge || isSimpler(*apart, *best) || isSimpler(*best, *apart));
  const auto isBetter = [&](const FrontSurface& front)
  {
    return (best->disorder() >= MostDisorder && front.disorder() < best->disorder()) ||
      showsBothLayers(front, *best) || closesMore(front, *best) || isSimpler(front, *best) ||
      isOfEdge;
  };
  if (apart && (!best || isBetter(*apart)))
  {
    best = std::move(apart);
  }
  // Which of them is right in thin places is chance: others are asked.
  const auto isUnsettled = [&] { return isInDoubt(*best) || (isOfEdge && isTorn(*best)); };
  bool asksAnother = areAtOdds && isUnsettled();
  for (std::uint64_t i = 1; asksAnother && i <= FrontsAtOdds; ++i)
  {
    bool isReplaced = false;
    const double at = 0.75 + 0.25 * double(i - 1) / double(FrontsAtOdds);
    auto other = frontOf(Layers::Apart, SeedOfFront + i, at, at + 0.25 / double(FrontsAtOdds));
    // Without a limb, or one side of a blade, it would be simpler, too.
    const bool hasArea = other && areaOf(other->mesh) >= AreaOfOther * areaOf(best->mesh);
    if (hasArea &&
      ((isSimpler(*other, *best) && genusOf(other->mesh) < genusOf(best->mesh)) ||
        (isOfEdge && isLessTorn(*other, *best))))
    {
      best = std::move(other);
      isReplaced = true;
    }
    // Handles that no two fronts agree on may be chance, too, though they are not narrow.
    asksAnother = isUnsettled() || (isReplaced && genusOf(best->mesh) > 0);
  }
  if (best)
  {
    best->reachesEdges = isOfEdge;
  }
  return best && best->disorder() <= MostDisorderAtAll ? std::move(best) : std::nullopt;
}

std::optional<FrontSurface> bestFront(const PointCloud& cloud, const NearestPoints& nearest,
  std::size_t mostVertices, const Progress& progress, double leastPiece, bool mustBeCertain)
{
  PointLayers pointLayers(nearest, std::clamp(mostVertices, LeastSamples, MostSamples));
  return bestFront(
    [&](Layers layers, std::uint64_t seed, double begin, double end)
    {
      return frontSurface(cloud, pointLayers, layers, seed, partOf(progress, begin, end),
        leastPiece, mustBeCertain ? MostScatter : 1.);
    });
}
}
