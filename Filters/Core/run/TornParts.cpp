// SPDX-License-Identifier: BSD-3-Clause
#include "run/TornParts.h"

#include "cloud/NearestPoints.h"
#include "mesh/BoxTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t NeighborsAtTear = 16;
/// Of these, so many of another piece go on where the own end.
constexpr std::size_t FewestBeyond = 3;
/// Along the way to the middle of the others, the own neighbours lie as far back, and the others as far on, against how
/// far all lie: 0.85 where a disc or a rod is halved, 0.3 by chance where both lie all around.
constexpr double LeastApart = 0.5;
/// On both sides of a tear together: fewer points are at an end by chance.
constexpr std::size_t FewestAtTear = 8;
/// ... and of all that have both near them, these are a third at a tear, but a tenth at most where bodies touch.
constexpr double LeastPartAtTear = 0.15;
/// A piece has so many points of its own: others are scraps that lie on something else.
constexpr std::size_t FewestOfTornPiece = 8;

/// Points that follow each other, more than are looked for around one of them.
constexpr std::size_t PlacesOfBlock = 32;
static_assert(PlacesOfBlock > NeighborsAtTear);
/// From the middle of a block to what is no farther than its diagonal from one of its points, and a little more.
constexpr float ReachOfBlock = 1.51f;
constexpr std::size_t BlocksPerRange = 8;
constexpr std::uint32_t NoPiece = std::uint32_t(-1);

class TearSearch
{
public:
  TearSearch(const PointCloud& cloud, const PointDistances& distances,
    const std::function<bool(std::size_t)>& isAsked)
    : cloud_(cloud)
  {
    for (std::size_t i = 0; i < distances.points.size(); ++i)
    {
      if (isAsked(i))
      {
        places_.push_back(cloud.points()[distances.points[i]]);
        pieces_.push_back(distances.pieces[i]);
      }
    }
    for (const std::uint32_t piece : pieces_)
    {
      counts_.resize(std::max(counts_.size(), std::size_t(piece) + 1), 0);
      ++counts_[piece];
    }
    nearest_.emplace(places_);
  }

  TornParts run(const Executor& executor) const
  {
    std::vector<Look> looks(places_.size());
    executor.forEachRange((places_.size() + PlacesOfBlock - 1) / PlacesOfBlock, BlocksPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t block = begin; block < end; ++block)
        {
          const std::size_t first = block * PlacesOfBlock;
          const std::size_t last = std::min(first + PlacesOfBlock, places_.size());
          if (isWithinPiece(first, last))
          {
            continue;
          }
          for (std::size_t i = first; i < last; ++i)
          {
            looks[i] = lookAround(std::uint32_t(i));
          }
        }
      });
    return tearsOf(looks);
  }

private:
  struct Look
  {
    std::uint32_t other = NoPiece; ///< the piece that is near a point beside its own
    bool isAtEnd = false;          ///< whether its own ends there, and the other one goes on
  };

  /// Whether all points around those of a full block belong to one piece. The nearest of a point lie no farther than the
  /// diagonal of its block: nothing is to be found there.
  bool isWithinPiece(std::size_t first, std::size_t last) const
  {
    if (last - first < PlacesOfBlock)
    {
      return false;
    }
    Box box;
    for (std::size_t i = first; i < last; ++i)
    {
      box.extend(places_[i]);
    }
    bool isOfOne = true;
    nearest_->forEachWithin(0.5f * (box.low + box.high),
      ReachOfBlock * std::sqrt(squaredNorm(box.high - box.low)),
      [&](std::uint32_t i, float) { isOfOne = isOfOne && pieces_[i] == pieces_[first]; });
    return isOfOne;
  }

  Look lookAround(std::uint32_t i) const
  {
    std::array<NearPoint, NeighborsAtTear + 1> near;
    const std::size_t found = nearest_->find(places_[i], near);
    const auto isOfOther = [&](const NearPoint& point)
    { return pieces_[point.index] != pieces_[i] && isOfTornPiece(point.index); };
    const std::span<const NearPoint> around = std::span(near).first(found);
    const auto first = std::ranges::find_if(around, isOfOther);
    if (first == around.end())
    {
      return {};
    }
    const std::uint32_t other = pieces_[first->index];
    std::vector<Eigen::Vector3d> own, others;
    for (const NearPoint& point : around)
    {
      const std::uint32_t piece = pieces_[point.index];
      if (point.index != i && (piece == pieces_[i] || piece == other))
      {
        (piece == other ? others : own).push_back((places_[point.index] - places_[i]).toDouble());
      }
    }
    return own.size() >= FewestBeyond && others.size() >= FewestBeyond
      ? Look{ other, areApart(own, others) }
      : Look{};
  }

  bool isOfTornPiece(std::size_t i) const { return counts_[pieces_[i]] >= FewestOfTornPiece; }

  static bool areApart(
    const std::vector<Eigen::Vector3d>& own, const std::vector<Eigen::Vector3d>& others)
  {
    const Eigen::Vector3d way =
      std::accumulate(others.begin(), others.end(), Eigen::Vector3d(0., 0., 0.)).normalized();
    double squares = 0.;
    const auto meanAlong = [&](const std::vector<Eigen::Vector3d>& offsets)
    {
      double sum = 0.;
      for (const Eigen::Vector3d& offset : offsets)
      {
        const double along = offset.dot(way);
        sum += along;
        squares += along * along;
      }
      return sum / double(offsets.size());
    };
    const double back = -meanAlong(own), on = meanAlong(others);
    const double least = LeastApart * std::sqrt(squares / double(own.size() + others.size()));
    return back > least && on > least;
  }

  TornParts tearsOf(const std::vector<Look>& looks) const
  {
    struct Tear
    {
      std::size_t near = 0;
      std::vector<Vector4> points; ///< at the ends of both
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Tear> tears;
    for (std::size_t i = 0; i < looks.size(); ++i)
    {
      if (looks[i].other != NoPiece && isOfTornPiece(i))
      {
        Tear& tear = tears[std::minmax(pieces_[i], looks[i].other)];
        ++tear.near;
        if (looks[i].isAtEnd)
        {
          tear.points.push_back(places_[i]);
        }
      }
    }
    TornParts result;
    std::size_t most = 0;
    for (const auto& [pieces, tear] : tears)
    {
      const std::size_t points = tear.points.size();
      if (points < FewestAtTear || double(points) < LeastPartAtTear * double(tear.near))
      {
        continue;
      }
      ++result.tears;
      if (points > most)
      {
        most = points;
        result.place = cloud_.toInput(inTheMiddle(tear.points));
      }
    }
    return result;
  }

  /// The point closest to the mean: of a long tear that may lie far from all.
  static Vector4 inTheMiddle(const std::vector<Vector4>& points)
  {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Vector4 point : points)
    {
      mean += point.toDouble() / double(points.size());
    }
    return *std::ranges::min_element(
      points, {}, [&](Vector4 point) { return (point.toDouble() - mean).squaredNorm(); });
  }

  const PointCloud& cloud_;
  std::vector<Vector4> places_;
  std::vector<std::uint32_t> pieces_;
  std::vector<std::size_t> counts_;
  std::optional<NearestPoints> nearest_;
};
}

TornParts findTornParts(const PointCloud& cloud, const PointDistances& distances,
  const std::function<bool(std::size_t)>& isAsked, const Executor& executor)
{
  return distances.pieces.empty() ? TornParts()
                                  : TearSearch(cloud, distances, isAsked).run(executor);
}
}
