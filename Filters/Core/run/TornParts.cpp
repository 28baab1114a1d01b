// SPDX-License-Identifier: BSD-3-Clause
#include "run/TornParts.h"

#include "cloud/NearestPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t NeighborsAtTear = 16;
/// Of these, so many of another piece go on where the own end.
constexpr std::size_t FewestBeyond = 3;
/// The middle of the own neighbours is so far back from where the others are, against how far all are: of half a disc
/// it is 0.6, all around it is 0.2 at most, by chance.
constexpr double LeastBack = 0.35;
/// On both sides of a tear together: fewer points are at an end by chance.
constexpr std::size_t FewestAtTear = 8;
/// A piece has so many points of its own: others are scraps that lie on something else.
constexpr std::size_t FewestOfTornPiece = 8;

constexpr std::size_t TornPerRange = 256;
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
    std::vector<std::uint32_t> beyond(places_.size(), NoPiece);
    executor.forEachRange(places_.size(), TornPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          beyond[i] = pieceBeyond(std::uint32_t(i));
        }
      });
    return tearsOf(beyond);
  }

private:
  /// That goes on where the piece of a point ends; NoPiece if it does not end there, or nothing goes on.
  std::uint32_t pieceBeyond(std::uint32_t i) const
  {
    const std::uint32_t own = pieces_[i];
    std::array<NearPoint, NeighborsAtTear + 1> near;
    const std::size_t found = nearest_->find(places_[i], near);
    Eigen::Vector3d sumOfOwn = Eigen::Vector3d::Zero(), sumOfOther = sumOfOwn;
    std::size_t count = 0, ofOwn = 0;
    std::uint32_t other = NoPiece;
    double squares = 0.;
    for (std::size_t k = 0; k < found; ++k)
    {
      const std::uint32_t piece = pieces_[near[k].index];
      if (near[k].index == i || counts_[piece] < FewestOfTornPiece)
      {
        continue;
      }
      const Eigen::Vector3d offset = (places_[near[k].index] - places_[i]).toDouble();
      squares += offset.squaredNorm();
      if (piece == own)
      {
        sumOfOwn += offset;
        ++ofOwn;
      }
      else if (other == NoPiece || piece == other)
      {
        other = piece;
        sumOfOther += offset;
        ++count;
      }
    }
    if (count < FewestBeyond || ofOwn < FewestBeyond || !(sumOfOther.norm() > 0.))
    {
      return NoPiece;
    }
    const double radius = std::sqrt(squares / double(count + ofOwn));
    const double back = -sumOfOwn.dot(sumOfOther.normalized()) / double(ofOwn);
    return back > LeastBack * radius ? other : NoPiece;
  }

  TornParts tearsOf(const std::vector<std::uint32_t>& beyond) const
  {
    struct Tear
    {
      std::size_t points = 0;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Tear> tears;
    for (std::size_t i = 0; i < beyond.size(); ++i)
    {
      if (beyond[i] != NoPiece && counts_[pieces_[i]] >= FewestOfTornPiece)
      {
        Tear& tear = tears[std::minmax(pieces_[i], beyond[i])];
        ++tear.points;
        tear.sum += places_[i].toDouble();
      }
    }
    TornParts result;
    std::size_t most = 0;
    for (const auto& [pieces, tear] : tears)
    {
      if (tear.points < FewestAtTear)
      {
        continue;
      }
      ++result.tears;
      if (tear.points > most)
      {
        most = tear.points;
        result.place = cloud_.toInput(Vector4(Eigen::Vector3d(tear.sum / double(tear.points))));
      }
    }
    return result;
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
