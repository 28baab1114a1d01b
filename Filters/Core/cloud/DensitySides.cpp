// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/DensitySides.h"

#include "cloud/NearestPoints.h"
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
#include <numeric>
#include <optional>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the area: what has no certain side.
constexpr double LeastOpenQuestion = 0.5;
/// Of the area: smaller pieces are no rooms.
constexpr double LeastRoom = 0.2;
/// Triangles at which the density is measured, and of a room, at least.
constexpr std::size_t DensityProbes = 1000;
constexpr std::size_t FewestProbes = 100;
/// By so many points, whose number is known to a fifth then.
constexpr std::size_t PointsPerProbe = 32;
/// Of the logarithm of the density: its variance where points are even, twice. No more tells nothing.
constexpr double VarianceByChance = 2. / double(PointsPerProbe);
/// Of the logarithm of the density: what is farther off the law lies beside a boundary or an edge, or across a gap, and
/// counts as much as that.
constexpr double FarthestOff = 2.;
/// Of the angle between look and normal: noise and curvature show more of what is seen along the surface.
constexpr double LeastCosineOfLook = 0.1;
/// Places of the first look, along each axis, and how far they reach out of the box, in its diagonals, if the scanner
/// may have stood outside.
constexpr int PlacesPerAxis = 7;
constexpr double ReachOutside = 0.6;
/// The best so many are improved, by steps of these fractions of the diagonal.
constexpr std::size_t PlacesImproved = 3;
constexpr double FirstStride = 1. / 8.;
constexpr double LastStride = 1. / 128.;
/// Of the variance of the logarithm of the density: what the law must explain.
constexpr double LeastVariance = 0.5;
/// What it may leave, of what others leave: an even slope, and places that see the other sides. With so many probes that
/// is far beyond chance.
constexpr double MostOfOthers = 0.8;
/// Of probes: those that face a scanner less those that look away, for all face it where a surface was seen from it.
constexpr double LeastMajority = 0.5;
/// Of probes: what the surface hides from a scanner, which measures what it sees. Meshes span some of the gaps through
/// which it has seen.
constexpr double MostHidden = 0.15;
/// The same of a closed surface: there is a place below a scanner that it does not see, so most rooms are open.
constexpr double MostHiddenIfClosed = 0.04;
/// A rough surface does not hide itself: looks begin so many edges away.
constexpr double EdgesBeforeLook = 2.;

struct DensityProbe
{
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  std::size_t piece;
  double logDensity; ///< up to a summand
};

/// A place that explains the density.
struct Station
{
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  double variance = 0.; ///< what is left of it
};

/// The mean square of what lies off the median, which is reordered.
double varianceOf(std::vector<double>& values)
{
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const double median = *middle;
  const double sum = std::accumulate(values.begin(), values.end(), 0.,
    [median](double before, double value)
    { return before + std::pow(std::min(std::abs(value - median), FarthestOff), 2); });
  return sum / double(values.size());
}

/// As many triangles of a learnt mesh have as many points, so where these are sparse, which tells least, are few probes.
std::vector<DensityProbe> probesOn(
  const Mesh& mesh, std::span<const Piece> pieces, const NearestPoints& nearest)
{
  const std::size_t triangles = mesh.triangleCount(), count = std::min(DensityProbes, triangles);
  std::vector<DensityProbe> probes;
  std::array<NearPoint, PointsPerProbe> around;
  std::size_t passed = 0, picked = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      mesh.forEachTriangleFrom(v,
        [&](VertexIndex a, VertexIndex b, VertexIndex c)
        {
          // Spread over all of them.
          if (passed++ != (2 * picked + 1) * triangles / (2 * count))
          {
            return;
          }
          ++picked;
          const Eigen::Vector3d p = mesh.position(a).toDouble(), q = mesh.position(b).toDouble(),
                                r = mesh.position(c).toDouble();
          const Eigen::Vector3d place = (p + q + r) / 3.;
          const std::size_t found = nearest.findPlaces(Vector4(place), around);
          const double farthest = found > 0 ? double(around[found - 1].squaredDistance) : 0.;
          if (found == PointsPerProbe && farthest > 0.)
          {
            probes.push_back({ place, (q - p).cross(r - p).normalized(), i, -std::log(farthest) });
          }
        });
    }
  }
  return probes;
}

class StationSearch
{
public:
  StationSearch(const Mesh& mesh, std::vector<DensityProbe> probes, std::size_t pieceCount,
    const Executor& executor)
    : mesh_(mesh)
    , probes_(std::move(probes))
    , pieceCount_(pieceCount)
    , executor_(executor)
  {
    for (const DensityProbe& probe : probes_)
    {
      bounds_.extend(probe.place);
    }
  }

  /// The directions of pieces, 1 towards the scanner and -1 away from it, 0 where that is unknown; none if no place
  /// within `box` explains the density, or if more is hidden from it.
  std::optional<std::vector<int>> directions(
    const Eigen::AlignedBox3d& box, double mostHidden) const
  {
    if (probes_.size() < FewestProbes)
    {
      return std::nullopt;
    }
    const double all = varianceOfAll();
    if (all < VarianceByChance)
    {
      return std::nullopt;
    }
    const Station best = bestOf(box, [](const Eigen::Vector3d&) { return true; });
    if (best.variance > (1. - LeastVariance) * all ||
      best.variance > MostOfOthers * varianceBesideSlope())
    {
      return std::nullopt;
    }
    const std::vector<int> result = directionsTo(best.place);
    // A scanner sees one side only: a place from which there are both is none of the other sides, either.
    const Station opposite = bestOf(surroundings(),
      [&](const Eigen::Vector3d& place) { return agreement(place, result) < -LeastMajority; });
    const bool isTold =
      best.variance <= MostOfOthers * opposite.variance && partHiddenFrom(best.place) <= mostHidden;
    return isTold ? std::optional(result) : std::nullopt;
  }

  Eigen::AlignedBox3d surroundings() const
  {
    const Eigen::Vector3d reach =
      Eigen::Vector3d::Constant(ReachOutside * bounds_.diagonal().norm());
    return { bounds_.min() - reach, bounds_.max() + reach };
  }

private:
  double varianceOfAll() const
  {
    std::vector<double> values(probes_.size());
    std::transform(probes_.begin(), probes_.end(), values.begin(),
      [](const DensityProbe& probe) { return probe.logDensity; });
    return varianceOf(values);
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
    return varianceOf(values);
  }

  /// What a scanner at that place leaves.
  Station stationAt(const Eigen::Vector3d& place) const
  {
    std::vector<double> values(probes_.size());
    std::transform(probes_.begin(), probes_.end(), values.begin(),
      [&](const DensityProbe& probe)
      {
        const Eigen::Vector3d look = place - probe.place;
        const double square = std::max(look.squaredNorm(), 1e-6 * bounds_.diagonal().squaredNorm());
        const double cosine = std::abs(probe.normal.dot(look)) / std::sqrt(square);
        return probe.logDensity - std::log(std::max(cosine, LeastCosineOfLook) / square);
      });
    return { place, varianceOf(values) };
  }

  /// The best station in a box, of those that `isAsked`. Most are among what they see, so it is looked there more
  /// closely.
  template <typename IsAsked>
  Station bestOf(const Eigen::AlignedBox3d& box, const IsAsked& isAsked) const
  {
    const Station anywhere = bestIn(box, isAsked);
    const Station among = bestIn(box.intersection(bounds_), isAsked);
    return among.variance < anywhere.variance ? among : anywhere;
  }

  /// The same, if all places are looked at alike.
  template <typename IsAsked>
  Station bestIn(const Eigen::AlignedBox3d& box, const IsAsked& isAsked) const
  {
    std::vector<Eigen::Vector3d> places;
    for (int i = 0; i < PlacesPerAxis * PlacesPerAxis * PlacesPerAxis; ++i)
    {
      const Eigen::Array3i along(
        i % PlacesPerAxis, i / PlacesPerAxis % PlacesPerAxis, i / PlacesPerAxis / PlacesPerAxis);
      const Eigen::Vector3d place = box.min() +
        ((along.cast<double>() + 0.5) / double(PlacesPerAxis)).matrix().cwiseProduct(box.sizes());
      if (isAsked(place))
      {
        places.push_back(place);
      }
    }
    std::vector<Station> stations(places.size());
    executor_.forEachPart(
      places.size(), [&](std::size_t i) { stations[i] = stationAt(places[i]); });
    std::stable_sort(stations.begin(), stations.end(),
      [](const Station& a, const Station& b) { return a.variance < b.variance; });
    Station best{ box.center(), FarthestOff * FarthestOff };
    for (std::size_t i = 0; i < std::min(stations.size(), PlacesImproved); ++i)
    {
      const Station station = improved(stations[i], box, isAsked);
      best = station.variance < best.variance ? station : best;
    }
    return best;
  }

  template <typename IsAsked>
  Station improved(Station best, const Eigen::AlignedBox3d& box, const IsAsked& isAsked) const
  {
    const double diagonal = bounds_.diagonal().norm();
    for (double stride = FirstStride; stride >= LastStride;)
    {
      const Station start = best;
      for (int i = 0; i < 6; ++i)
      {
        const double way = (i % 2 == 0 ? stride : -stride) * diagonal;
        const Eigen::Vector3d place = start.place + way * Eigen::Vector3d::Unit(i / 2);
        if (!box.contains(place) || !isAsked(place))
        {
          continue;
        }
        const Station station = stationAt(place);
        best = station.variance < best.variance ? station : best;
      }
      stride = best.variance < start.variance ? stride : 0.5 * stride;
    }
    return best;
  }

  /// Of each piece: how many probes there are, and what faces the place less what looks away.
  std::vector<std::array<int, 2>> countsFrom(const Eigen::Vector3d& place) const
  {
    std::vector<std::array<int, 2>> counts(pieceCount_, std::array<int, 2>{});
    for (const DensityProbe& probe : probes_)
    {
      auto& [number, sum] = counts[probe.piece];
      ++number;
      sum += probe.normal.dot(place - probe.place) > 0. ? 1 : -1;
    }
    return counts;
  }

  std::vector<int> directionsTo(const Eigen::Vector3d& place) const
  {
    std::vector<int> result;
    for (const auto& [number, sum] : countsFrom(place))
    {
      const bool isClear = std::abs(sum) > LeastMajority * number;
      result.push_back(!isClear ? 0 : sum > 0 ? 1 : -1);
    }
    return result;
  }

  /// What faces the place less what looks away, of all probes, with these directions.
  double agreement(const Eigen::Vector3d& place, const std::vector<int>& directions) const
  {
    double result = 0.;
    const std::vector<std::array<int, 2>> counts = countsFrom(place);
    for (std::size_t i = 0; i < counts.size(); ++i)
    {
      result += double(directions[i] * counts[i][1]);
    }
    return result / double(probes_.size());
  }

  double partHiddenFrom(const Eigen::Vector3d& station) const
  {
    const TriangleMesh surface = trianglesIn(mesh_, executor_);
    const Visibility visibility(surface);
    const double before = EdgesBeforeLook * mesh_.meanEdge(executor_);
    std::vector<std::uint8_t> isHidden(probes_.size(), 0);
    executor_.forEachPart(probes_.size(),
      [&](std::size_t i)
      { isHidden[i] = visibility.isHidden(probes_[i].place, station, before) ? 1 : 0; });
    return double(std::count(isHidden.begin(), isHidden.end(), 1)) / double(probes_.size());
  }

  const Mesh& mesh_;
  std::vector<DensityProbe> probes_;
  std::size_t pieceCount_;
  const Executor& executor_;
  Eigen::AlignedBox3d bounds_;
};

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
  const NearestPoints nearest(cloud.points(), executor);
  const std::vector<DensityProbe> probes = probesOn(mesh, pieces, nearest);
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
    const StationSearch search(mesh, chosenFrom(probes, isWithin), pieces.size(), executor);
    const std::optional<std::vector<int>> directions =
      search.directions(boxes[hull], pieces[hull].isClosed ? MostHiddenIfClosed : MostHidden);
    if (directions && (*directions)[hull] == (known[hull].isTurned ? 1 : -1))
    {
      tell(*directions, isWithin);
    }
  }
  if (openQuestion >= LeastOpenQuestion * area)
  {
    const StationSearch search(mesh, probes, pieces.size(), executor);
    if (const std::optional<std::vector<int>> directions =
          search.directions(search.surroundings(), MostHidden))
    {
      tell(*directions, [&](std::size_t i) { return !known[i].isKnown() && !sides[i].isKnown(); });
    }
  }
  return sides;
}
}
