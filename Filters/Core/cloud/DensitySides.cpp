// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/DensitySides.h"

#include "cloud/DensityProbes.h"
#include "cloud/StationSearch.h"
#include "cloud/Visibility.h"
#include "mesh/NearestTriangle.h"

#include <Eigen/Core>
#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the area: what has no certain side.
constexpr double LeastOpenQuestion = 0.5;
/// Of the area: smaller pieces are no rooms.
constexpr double LeastRoom = 0.2;
constexpr std::size_t FewestProbes = 100;
/// How far stations reach out of the box, in its diagonals, if they may have stood outside.
constexpr double ReachOutside = 0.6;
/// Of the variance of the logarithm of the density: what stations must explain.
constexpr double LeastVariance = 0.5;
/// What they may leave, of what others leave: an even slope, and stations that see the other side. With so many probes
/// that is far beyond chance.
constexpr double MostOfOthers = 0.8;
/// Of what is seen of a piece: what faces stations less what looks away, for all faces them where a surface was seen.
constexpr double LeastMajority = 0.5;
/// Of probes: what the surface hides from all stations, which measure what they see. Meshes span some of the gaps
/// through which they have seen.
constexpr double MostHidden = 0.15;
/// The same of a closed surface: there is a place below a station that it does not see, so most rooms are open.
constexpr double MostHiddenIfClosed = 0.04;
/// A room is scanned from some places, a flat from as many as it has rooms.
constexpr std::size_t MostStations = 8;
/// Of the logarithm of the density: if it varies less, as where views around an object were joined, several stations on
/// either side explain it.
constexpr double LeastVarianceOfSeveral = 0.25;
/// Of the diagonal: how closely the density tells where a station was.
constexpr double StationKnownTo = 1. / 128.;
/// A rough surface does not hide itself: looks begin so many edges away.
constexpr double EdgesBeforeLook = 2.;

/// What stations see.
struct Looks
{
  std::vector<int>
    directions;       ///< of pieces: 1 towards them, -1 away from them, 0 where that is unknown
  double hidden = 0.; ///< part of the probes that none of them sees
};

/// What of a surface is seen from stations.
class Sight
{
public:
  /// The mesh, probes and what runs on threads are referred to.
  Sight(const Mesh& mesh, const std::vector<DensityProbe>& probes, std::size_t pieceCount,
    const Executor& executor)
    : probes_(probes)
    , pieceCount_(pieceCount)
    , executor_(executor)
    , surface_(trianglesIn(mesh, executor))
    , visibility_(surface_)
    , beforeLook_(EdgesBeforeLook * mesh.meanEdge(executor))
    , diagonal_(boundsOf(probes).diagonal().norm())
  {
  }

  Looks looksOf(std::span<const Eigen::Vector3d> stations) const
  {
    // How many stations see a probe, and those that see its front less those that see its back.
    std::vector<std::array<int, 2>> ofProbes(probes_.size());
    executor_.forEachPart(probes_.size(),
      [&](std::size_t i)
      {
        const DensityProbe& probe = probes_[i];
        auto& [count, sum] = ofProbes[i] = {};
        for (const Eigen::Vector3d& station : stations)
        {
          const bool isSeen = !visibility_.isHidden(probe.place, station, beforeLook_);
          const int side = probe.normal.dot(station - probe.place) > 0. ? 1 : -1;
          count += isSeen ? 1 : 0;
          sum += isSeen ? side : 0;
        }
      });
    Looks looks;
    std::vector<std::array<int, 2>> ofPieces(pieceCount_, std::array<int, 2>{});
    for (std::size_t i = 0; i < probes_.size(); ++i)
    {
      const auto& [count, sum] = ofProbes[i];
      looks.hidden += (count == 0 ? 1. : 0.) / double(probes_.size());
      ofPieces[probes_[i].piece][0] += count;
      ofPieces[probes_[i].piece][1] += sum;
    }
    for (const auto& [count, sum] : ofPieces)
    {
      const bool isClear = std::abs(sum) > LeastMajority * count;
      looks.directions.push_back(!isClear ? 0 : sum > 0 ? 1 : -1);
    }
    return looks;
  }

  /// Of a station about there. What lies close to it would hide much from a place a little beside it.
  Looks leastHidden(const Eigen::Vector3d& station) const
  {
    Looks best = looksOf(std::array{ station });
    for (int i = 0; i < 6; ++i)
    {
      const double way = (i % 2 == 0 ? 1. : -1.) * StationKnownTo * diagonal_;
      const Eigen::Vector3d beside = station + way * Eigen::Vector3d::Unit(i / 2);
      Looks looks = looksOf(std::array{ beside });
      if (looks.hidden < best.hidden)
      {
        best = std::move(looks);
      }
    }
    return best;
  }

private:
  const std::vector<DensityProbe>& probes_;
  std::size_t pieceCount_;
  const Executor& executor_;
  TriangleMesh surface_;
  Visibility visibility_;
  double beforeLook_;
  double diagonal_;
};

/// How well stations explain the density of a scene.
class StationEvidence
{
public:
  /// Probes and what runs on threads are referred to.
  StationEvidence(
    const std::vector<DensityProbe>& probes, std::size_t pieceCount, const Executor& executor)
    : probes_(probes)
    , pieceCount_(pieceCount)
    , executor_(executor)
    , bounds_(boundsOf(probes))
  {
  }

  bool isEnough() const
  {
    return probes_.size() >= FewestProbes && varianceOfAll() >= densityVarianceByChance();
  }

  bool isEnoughForSeveral() const { return varianceOfAll() >= LeastVarianceOfSeveral; }

  Eigen::AlignedBox3d surroundings() const
  {
    const Eigen::Vector3d reach =
      Eigen::Vector3d::Constant(ReachOutside * bounds_.diagonal().norm());
    return { bounds_.min() - reach, bounds_.max() + reach };
  }

  bool isExplainedBy(const Stations& stations) const
  {
    return stations.variance <= (1. - LeastVariance) * varianceOfAll() &&
      stations.variance <= MostOfOthers * varianceBesideSlope();
  }

  /// One station, which may see both sides.
  StationSearch one(const Eigen::AlignedBox3d& box) const
  {
    StationSearch search(probes_, std::nullopt, box, executor_);
    search.add();
    return search;
  }

  /// One station that sees the other sides.
  StationSearch oneAgainst(const std::vector<int>& directions) const
  {
    StationSearch search(probes_, std::nullopt, surroundings(), executor_,
      [&](const Eigen::Vector3d& place) { return agreement(place, directions) < -LeastMajority; });
    search.add();
    return search;
  }

  /// Several, that see one side of the hull.
  StationSearch several(const Eigen::AlignedBox3d& box, const FacingPiece& hull) const
  {
    return { probes_, hull, box, executor_ };
  }

private:
  /// What faces the place less what looks away, of all probes, with these directions.
  double agreement(const Eigen::Vector3d& place, const std::vector<int>& directions) const
  {
    double sum = 0.;
    for (const DensityProbe& probe : probes_)
    {
      sum += directions[probe.piece] * (probe.normal.dot(place - probe.place) > 0. ? 1. : -1.);
    }
    return sum / double(probes_.size());
  }

  double varianceOfAll() const
  {
    std::vector<double> values(probes_.size());
    std::transform(probes_.begin(), probes_.end(), values.begin(),
      [](const DensityProbe& probe) { return probe.logDensity; });
    return densityVariance(values);
  }

  /// What a density leaves that falls evenly in some direction, and is another one on each piece.
  double varianceBesideSlope() const
  {
    std::vector<Eigen::Vector4d> means(pieceCount_, Eigen::Vector4d::Zero());
    std::vector<double> numbers(pieceCount_, 0.);
    for (const DensityProbe& probe : probes_)
    {
      means[probe.piece] +=
        Eigen::Vector4d(probe.place.x(), probe.place.y(), probe.place.z(), probe.logDensity);
      numbers[probe.piece] += 1.;
    }
    const auto count = Eigen::Index(probes_.size());
    Eigen::MatrixXd places(count, 3);
    Eigen::VectorXd densities(count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const DensityProbe& probe = probes_[std::size_t(i)];
      const Eigen::Vector4d mean = means[probe.piece] / numbers[probe.piece];
      places.row(i) = (probe.place - mean.head<3>()).transpose();
      densities[i] = probe.logDensity - mean[3];
    }
    const Eigen::VectorXd off = densities - places * places.colPivHouseholderQr().solve(densities);
    std::vector<double> values(off.begin(), off.end());
    return densityVariance(values);
  }

  const std::vector<DensityProbe>& probes_;
  std::size_t pieceCount_;
  const Executor& executor_;
  Eigen::AlignedBox3d bounds_;
};

bool isClearlyBetter(const StationSearch& one, const StationSearch& other)
{
  return one.stations().variance <= MostOfOthers * other.stations().variance;
}

/// By one station. It may see both sides here and there, as meshes have parts that are turned wrongly.
template <typename SightOfScene>
std::optional<Looks> looksOfOne(
  const StationEvidence& evidence, const Eigen::AlignedBox3d& box, const SightOfScene& sight)
{
  const StationSearch search = evidence.one(box);
  if (!evidence.isExplainedBy(search.stations()))
  {
    return std::nullopt;
  }
  Looks looks = sight().leastHidden(search.stations().places.front());
  // A station sees one side only: a place from which there are both is none of the other sides, either.
  return isClearlyBetter(search, evidence.oneAgainst(looks.directions))
    ? std::optional(std::move(looks))
    : std::nullopt;
}

/// By the fewest stations that see that side of the hull and explain clearly more than as many that see the other one.
template <typename SightOfScene>
std::optional<Looks> looksOfSeveral(const StationEvidence& evidence, const Eigen::AlignedBox3d& box,
  const FacingPiece& hull, const SightOfScene& sight)
{
  if (!evidence.isEnoughForSeveral())
  {
    return std::nullopt;
  }
  StationSearch search = evidence.several(box, hull);
  StationSearch opposite = evidence.several(evidence.surroundings(), { hull.piece, -hull.facing });
  for (std::size_t count = 1; count <= MostStations && search.add(); ++count)
  {
    opposite.add();
    if (count == 1)
    {
      continue;
    }
    if (evidence.isExplainedBy(search.stations()) && isClearlyBetter(search, opposite))
    {
      return sight().looksOf(search.stations().places);
    }
  }
  return std::nullopt;
}

/// Those whose pieces `isAsked`.
template <typename IsAsked>
std::vector<DensityProbe> chosenFrom(
  const std::vector<DensityProbe>& probes, const IsAsked& isAsked)
{
  std::vector<DensityProbe> chosen;
  std::copy_if(probes.begin(), probes.end(), std::back_inserter(chosen),
    [&](const DensityProbe& probe) { return isAsked(probe.piece); });
  return chosen;
}
}

std::vector<Side> sidesByDensity(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> known, const PointCloud& cloud, const Executor& executor)
{
  std::vector<Side> sides(pieces.size());
  const std::vector<DensityProbe> probes = densityProbes(mesh, pieces, cloud, executor);
  const std::vector<Eigen::AlignedBox3d> boxes = boxesOf(mesh, pieces);
  double area = 0., openQuestion = 0.;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    area += pieces[i].area;
    openQuestion += known[i].isKnown() ? 0. : pieces[i].area;
  }
  const auto tell = [&](const std::vector<int>& directions, const auto& isAsked)
  {
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      if (isAsked(i) && directions[i] != 0)
      {
        sides[i] = { SideEvidence::Density, directions[i] < 0, true };
      }
    }
  };
  for (std::size_t hull = 0; hull < pieces.size(); ++hull)
  {
    if (!known[hull].isKnown() || sides[hull].isKnown() || pieces[hull].area < LeastRoom * area)
    {
      continue;
    }
    const auto isWithin = [&](std::size_t i) { return boxes[hull].contains(boxes[i]); };
    const std::vector<DensityProbe> within = chosenFrom(probes, isWithin);
    const StationEvidence evidence(within, pieces.size(), executor);
    const auto sight = [&] { return Sight(mesh, within, pieces.size(), executor); };
    if (!evidence.isEnough())
    {
      continue;
    }
    const int inwards = known[hull].isTurned ? 1 : -1;
    std::optional<Looks> looks = looksOfOne(evidence, boxes[hull], sight);
    if (!looks)
    {
      looks = looksOfSeveral(evidence, boxes[hull], { hull, inwards }, sight);
    }
    if (looks && looks->hidden <= (pieces[hull].isClosed ? MostHiddenIfClosed : MostHidden) &&
      looks->directions[hull] == inwards)
    {
      tell(looks->directions, isWithin);
    }
  }
  if (openQuestion >= LeastOpenQuestion * area)
  {
    const StationEvidence evidence(probes, pieces.size(), executor);
    const auto sight = [&] { return Sight(mesh, probes, pieces.size(), executor); };
    if (!evidence.isEnough())
    {
      return sides;
    }
    const std::optional<Looks> looks = looksOfOne(evidence, evidence.surroundings(), sight);
    if (looks && looks->hidden <= MostHidden)
    {
      tell(looks->directions,
        [&](std::size_t i) { return !known[i].isKnown() && !sides[i].isKnown(); });
    }
  }
  return sides;
}
}
