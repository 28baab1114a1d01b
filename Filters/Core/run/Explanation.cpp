// SPDX-License-Identifier: BSD-3-Clause
#include "run/Explanation.h"

#include "base/DisjointSets.h"
#include "base/Median.h"
#include "cloud/NearestPoints.h"
#include "run/CutOffPoints.h"
#include "run/GroupsBeyondNoise.h"
#include "run/LocalVariation.h"
#include "start/LayerSearch.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
/// A point is away from the mesh if its distance is more than so many of its spacings, and more
/// than the noise, MediansAway.
constexpr float SpacingsAway = 3.f;
/// If the mesh misses most points, their median distance is not noise. It is then more than so many
/// usual spacings, or a part of an edge: where a mesh cuts off bends, it is a third of that. The noise is then
/// measured in the layers of so many points. Noise spreads points that are three medians apart as far as one across
/// their layer: that is a fifth of the variance.
constexpr float SpacingsOfNoise = 3.f;
constexpr double EdgesOfNoise = 0.15;
constexpr float MediansOfBall = 3.f;
constexpr double LeastVariationOfNoise = 0.1;
constexpr std::size_t LayersOfNoise = 200;
/// The spacing of an outlier is so many times that of its neighbours.
constexpr float LoneSpacings = 3.f;
/// Sparse points that are away from the mesh form a surface if the variance across it is less than
/// this part of the whole, on average over neighbourhoods of a few points. For random points in
/// space it is about an eighth.
constexpr double MostVariation = 0.07;
/// A point is no outlier if its distance to the mesh is less than this part of its spacing.
constexpr float LonePartOfSpacing = 0.5f;
/// Points belong to one piece if they are closer than so many of their spacings ...
constexpr float SpacingsOfPiece = 2.5f;
constexpr std::size_t NeighborsInPiece = 16;
/// ... or than so many edges: a mesh with these edges does not separate them.
constexpr double EdgesOfPiece = 2.;
/// A piece has at least so many of the points that were asked. Fewer lie together by chance.
constexpr double LeastAskedInPiece = 4.;

/// A small piece is a part of the scan if it has so many points, ...
constexpr double FewestInSmallPart = 24.;
/// ... and those are not sparser than usual, but for chance. Strewn outliers are.
constexpr float MostSpacingOfSmallPart = 1.5f;

/// Of a fine mesh edges are not longer than so many distances between points. Without noise, it lacks what a few points
/// show that belong together and are off it by such a part of their own distances.
constexpr double SpacingsOfFineEdge = 3.;
constexpr float SpacingsPassedBy = 0.25f;
/// ... and of any mesh where more than half of those of a piece are.
constexpr float SpacingsPassedByPiece = 0.5f;
constexpr std::size_t FewestPassedBy = 8;

constexpr std::size_t SpacingsAsked = 500;
constexpr std::size_t ExplainedPerRange = 256;

class Explainer
{
public:
  Explainer(const PointCloud& cloud, PointDistances distances, const ExplanationRules& rules,
    const Executor& executor)
    : cloud_(cloud)
    , rules_(rules)
    , executor_(executor)
    , nearest_(cloud.points(), executor)
  {
    result_.asked = std::move(distances);
    result_.reasons.assign(result_.asked.points.size(), Reason::Explained);
  }

  Explanation run() &&
  {
    if (!result_.reasons.empty())
    {
      survey();
      tellApart();
      findPieces();
      findPassedBy();
      for (std::vector<MissedPiece>* pieces :
        { &result_.pieces, &result_.smallParts, &result_.passedBy })
      {
        std::stable_sort(pieces->begin(), pieces->end(),
          [](const MissedPiece& a, const MissedPiece& b) { return a.points > b.points; });
      }
      result_.torn = findTornParts(
        cloud_, result_.asked,
        [this](std::size_t i) { return result_.reasons[i] == Reason::Explained; }, executor_);
    }
    count();
    findCutOff(cloud_, { spacings_, usualSpacing_, LoneSpacings * usualSpacing_, noise_ },
      rules_.usuallyAsked, result_);
    return std::move(result_);
  }

private:
  float spacingOf(std::size_t i) const { return pointSpacing(nearest_, result_.asked.points[i]); }

  /// Measures the usual spacing and the noise.
  void survey()
  {
    const std::vector<float>& distances = result_.asked.distances;
    const std::size_t all = distances.size(), asked = std::min(all, SpacingsAsked);
    std::vector<float> spacings(asked);
    for (std::size_t i = 0; i < asked; ++i)
    {
      spacings[i] = spacingOf(i * all / asked);
    }
    usualSpacing_ = medianOf(std::move(spacings));
    float median = medianOf(distances, executor_);
    if (median > SpacingsOfNoise * usualSpacing_ || liesOffTheLayers(median))
    {
      std::vector<float> moves;
      const std::size_t layers = std::min(all, LayersOfNoise);
      for (std::size_t i = 0; i < layers; ++i)
      {
        const std::uint32_t point = result_.asked.points[i * all / layers];
        if (const auto place = placeInLayer(nearest_, point))
        {
          moves.push_back(std::sqrt(squaredNorm(*place - cloud_.points()[point])));
        }
      }
      median = moves.empty() ? median : std::min(median, medianOf(std::move(moves)));
    }
    noise_ = MediansAway * median;
  }

  bool liesOffTheLayers(float median) const
  {
    if (double(median) <= EdgesOfNoise * result_.asked.meanEdge)
    {
      return false;
    }
    const std::size_t all = result_.asked.points.size(), asked = std::min(all, LayersOfNoise);
    double sum = 0.;
    std::vector<NearPoint> near;
    for (std::size_t i = 0; i < asked; ++i)
    {
      near.clear();
      nearest_.forEachWithin(placeOf(i * all / asked), MediansOfBall * median,
        [&](std::uint32_t index, float squared) {
          near.push_back({ squared, index });
        });
      sum += variationOf(near, cloud_.points());
    }
    return sum < LeastVariationOfNoise * double(asked);
  }

  bool isSparse(std::size_t i) const { return spacings_[i] > LoneSpacings * usualSpacing_; }

  /// Whether the spacing of a point is much larger than those of its neighbours.
  bool isLone(std::uint32_t point, float spacing) const
  {
    std::array<NearPoint, Neighbors + 1> near;
    const std::size_t found = nearest_.find(cloud_.points()[point], near);
    std::vector<float> around;
    for (std::size_t i = 0; i < found; ++i)
    {
      if (near[i].index != point)
      {
        around.push_back(pointSpacing(nearest_, near[i].index));
      }
    }
    return around.empty() || spacing > LoneSpacings * medianOf(std::move(around));
  }

  /// Marks each point as explained, outlier or unreachable. findPieces() judges the unreachable
  /// ones.
  void tellApart()
  {
    const std::size_t all = result_.asked.points.size();
    spacings_.assign(all, 0.f);
    executor_.forEachRange(all, ExplainedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          result_.reasons[i] = reasonOf(i);
        }
      });
  }

  Reason reasonOf(std::size_t i)
  {
    const auto point = result_.asked.points[i];
    const float distance = result_.asked.distances[i];
    if (!(distance > noise_))
    {
      return Reason::Explained;
    }
    if (!rules_.isLeftOut.empty() && rules_.isLeftOut[point] != 0)
    {
      return Reason::Outlier;
    }
    spacings_[i] = pointSpacing(nearest_, point);
    if (distance > LonePartOfSpacing * spacings_[i] && isLone(point, spacings_[i]))
    {
      return Reason::Outlier;
    }
    // findPieces() judges a sparse point near the mesh together with the points around it.
    return isFar(i) || isSparse(i) ? Reason::Unreachable : Reason::Explained;
  }

  bool isFar(std::size_t i) const
  {
    return result_.asked.distances[i] > SpacingsAway * spacings_[i];
  }

  /// Joins unreachable points that belong together. A piece that forms no layer consists of
  /// outliers, and one with few points is a small piece.
  void findPieces()
  {
    std::vector<std::size_t> missed;
    std::vector<Vector4> places;
    for (std::size_t i = 0; i < result_.reasons.size(); ++i)
    {
      if (result_.reasons[i] == Reason::Unreachable)
      {
        missed.push_back(i);
        places.push_back(cloud_.points()[result_.asked.points[i]]);
      }
    }
    DisjointSets sets(missed.size());
    joinNeighbors(sets, missed, places, float(std::sqrt(pointsPerAsked())));
    findVariations(missed, places);
    joinCells(sets, places);
    std::map<std::size_t, std::vector<std::size_t>> members;
    for (std::size_t m = 0; m < missed.size(); ++m)
    {
      members[sets.root(m)].push_back(missed[m]);
    }
    for (auto& [root, piece] : members)
    {
      judge(std::move(piece));
    }
  }

  double pointsPerAsked() const
  {
    return double(cloud_.points().size()) / double(result_.asked.points.size());
  }

  void judge(std::vector<std::size_t> piece)
  {
    double variation = 0.;
    std::size_t sparse = 0;
    for (const std::size_t i : piece)
    {
      variation += isSparse(i) ? variations_[i] : 0.;
      sparse += isSparse(i) ? 1 : 0;
    }
    if (variation > MostVariation * double(sparse))
    {
      // Dense points do not belong to the clutter around them.
      take(piece, Reason::Outlier, [this](std::size_t i) { return isSparse(i); });
    }
    take(piece, Reason::Explained, [this](std::size_t i) { return !isFar(i); });
    if (piece.empty())
    {
      return;
    }
    if (double(piece.size()) < LeastAskedInPiece || (isSmall(piece) && !isOfSurface(piece)))
    {
      if (isSmallPart(piece))
      {
        result_.smallParts.push_back(described(piece));
      }
      take(piece, Reason::SmallPiece, [](std::size_t) { return true; });
      return;
    }
    const MissedPiece missed = described(piece);
    // A rim is as coarse as its edges are long.
    if (!missed.isBeyondBoundary ||
      missed.farthest > cloud_.unit() * double(result_.asked.meanEdge))
    {
      result_.pieces.push_back(missed);
    }
  }

  MissedPiece described(const std::vector<std::size_t>& piece) const
  {
    MissedPiece missed;
    missed.points = pointsPerAsked() * double(piece.size());
    std::size_t beyond = 0;
    for (const std::size_t i : piece)
    {
      missed.center += cloud_.toInput(placeOf(i)) / double(piece.size());
      missed.farthest =
        std::max(missed.farthest, cloud_.unit() * double(result_.asked.distances[i]));
      beyond += result_.asked.isBeyondBoundary[i];
    }
    missed.isBeyondBoundary = 2 * beyond > piece.size();
    return missed;
  }

  /// Whether a small piece is no chance: there are enough points, as dense as others, and on a surface.
  bool isSmallPart(const std::vector<std::size_t>& piece) const
  {
    if (double(piece.size()) < LeastAskedInPiece ||
      pointsPerAsked() * double(piece.size()) < FewestInSmallPart)
    {
      return false;
    }
    std::vector<float> spacings;
    double variation = 0.;
    std::array<NearPoint, NeighborsInVariation> near;
    for (const std::size_t i : piece)
    {
      spacings.push_back(spacings_[i]);
      const std::size_t found = nearest_.find(placeOf(i), near);
      variation += variationOf(std::span(near).first(found), cloud_.points());
    }
    return medianOf(std::move(spacings)) <= MostSpacingOfSmallPart * usualSpacing_ &&
      variation <= MostVariation * double(piece.size());
  }

  bool isSmall(const std::vector<std::size_t>& piece) const
  {
    return double(piece.size()) < rules_.leastPiece * double(result_.asked.points.size());
  }

  /// Whether a piece continues explained points. Then it is a part of the surface that the mesh
  /// should have, however small it is.
  bool isOfSurface(const std::vector<std::size_t>& piece)
  {
    if (!nearestExplained_)
    {
      for (std::size_t i = 0; i < result_.reasons.size(); ++i)
      {
        if (result_.reasons[i] == Reason::Explained)
        {
          explained_.push_back(placeOf(i));
        }
      }
      nearestExplained_.emplace(explained_);
    }
    const float spacings = SpacingsOfPiece * float(std::sqrt(pointsPerAsked()));
    return std::any_of(piece.begin(), piece.end(),
      [&](std::size_t i)
      {
        const float reach = spacings * spacings_[i];
        std::array<NearPoint, 1> near;
        return nearestExplained_->find(placeOf(i), near) > 0 &&
          near[0].squaredDistance <= reach * reach;
      });
  }

  Vector4 placeOf(std::size_t i) const { return cloud_.points()[result_.asked.points[i]]; }

  /// Gives this reason to the points of a piece that meet a condition, and removes them from the
  /// piece.
  template <typename Condition>
  void take(std::vector<std::size_t>& piece, Reason reason, Condition isMeant)
  {
    for (const std::size_t i : piece)
    {
      result_.reasons[i] = isMeant(i) ? reason : result_.reasons[i];
    }
    std::erase_if(piece, isMeant);
  }

  /// For each sparse missed point, the part of the variance across the surface that it forms with
  /// other missed points.
  void findVariations(const std::vector<std::size_t>& missed, const std::vector<Vector4>& places)
  {
    const NearestPoints nearest(places);
    variations_.assign(result_.reasons.size(), 0.);
    std::array<NearPoint, NeighborsInVariation> near;
    for (std::size_t m = 0; m < missed.size(); ++m)
    {
      if (!isSparse(missed[m]))
      {
        continue;
      }
      const std::size_t found = nearest.find(places[m], near);
      variations_[missed[m]] = variationOf(std::span(near).first(found), places);
    }
  }

  void joinNeighbors(DisjointSets& sets, const std::vector<std::size_t>& missed,
    const std::vector<Vector4>& places, float thinning) const
  {
    const NearestPoints nearest(places);
    std::array<NearPoint, NeighborsInPiece> near;
    for (std::size_t m = 0; m < missed.size(); ++m)
    {
      const float reach = SpacingsOfPiece * thinning * spacings_[missed[m]];
      const std::size_t found = nearest.find(places[m], near);
      for (std::size_t i = 0; i < found && near[i].squaredDistance <= reach * reach; ++i)
      {
        sets.join(m, near[i].index);
      }
    }
  }

  /// Joins points in the same cell or in cells that touch.
  void joinCells(DisjointSets& sets, const std::vector<Vector4>& places) const
  {
    // Cells are not so small that their numbers overflow.
    const double width = std::max(EdgesOfPiece * result_.asked.meanEdge, 1e-6 * cloud_.diagonal());
    using Cell = std::array<long, 3>;
    std::map<Cell, std::size_t> firstIn;
    const auto cellOf = [&](Vector4 place)
    {
      const Eigen::Vector3d scaled = place.toDouble() / width;
      return Cell{ long(std::floor(scaled[0])), long(std::floor(scaled[1])),
        long(std::floor(scaled[2])) };
    };
    for (std::size_t m = 0; m < places.size(); ++m)
    {
      sets.join(m, firstIn.try_emplace(cellOf(places[m]), m).first->second);
    }
    constexpr int Around = 27;
    for (const auto& [cell, first] : firstIn)
    {
      for (int i = 0; i < Around; ++i)
      {
        const auto other =
          firstIn.find({ cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1 });
        if (other != firstIn.end())
        {
          sets.join(first, other->second);
        }
      }
    }
  }

  bool isExplainedBeyond(std::size_t i, float spacings) const
  {
    const float distance = result_.asked.distances[i];
    return result_.reasons[i] == Reason::Explained && distance > noise_ &&
      distance > spacings * spacings_[i];
  }

  /// A hole or a part as narrow as points are apart has no point that is far away.
  void findPassedBy()
  {
    if (result_.asked.meanEdge <= SpacingsOfFineEdge * double(usualSpacing_) &&
      noise_ <= SpacingsPassedBy * usualSpacing_)
    {
      std::vector<std::size_t> off;
      std::vector<Vector4> places;
      for (std::size_t i = 0; i < result_.reasons.size(); ++i)
      {
        // What lies beyond an end of the surface is told by warnings of its own.
        if (result_.asked.isBeyondBoundary[i] == 0 && isExplainedBeyond(i, SpacingsPassedBy))
        {
          off.push_back(i);
          places.push_back(placeOf(i));
        }
      }
      DisjointSets sets(off.size());
      joinNeighbors(sets, off, places, float(std::sqrt(pointsPerAsked())));
      std::map<std::size_t, std::vector<std::size_t>> groups;
      for (std::size_t m = 0; m < off.size(); ++m)
      {
        groups[sets.root(m)].push_back(off[m]);
      }
      for (const auto& [root, group] : groups)
      {
        addPassedBy(group);
      }
      return;
    }
    for (const auto& group : findGroupsBeyondNoise(cloud_, nearest_, result_.asked, usualSpacing_,
           [this](std::size_t i) { return result_.reasons[i] == Reason::Explained; }))
    {
      result_.passedBy.push_back(described(group));
    }
    std::map<std::uint32_t, std::vector<std::size_t>> pieces;
    for (std::size_t i = 0; i < result_.asked.pieces.size(); ++i)
    {
      pieces[result_.asked.pieces[i]].push_back(i);
    }
    for (auto& [number, piece] : pieces)
    {
      const std::size_t all = piece.size();
      std::erase_if(
        piece, [this](std::size_t i) { return !isExplainedBeyond(i, SpacingsPassedByPiece); });
      if (2 * piece.size() > all)
      {
        addPassedBy(piece);
      }
    }
  }

  void addPassedBy(const std::vector<std::size_t>& group)
  {
    if (group.size() >= FewestPassedBy)
    {
      result_.passedBy.push_back(described(group));
    }
  }

  void count()
  {
    for (const Reason reason : result_.reasons)
    {
      result_.counts[std::size_t(reason)] += pointsPerAsked();
    }
    result_.counts[std::size_t(Reason::Outlier)] += double(cloud_.farPoints().size());
    result_.counts[std::size_t(Reason::Dropped)] = double(cloud_.droppedCount());
  }

  static constexpr std::size_t Neighbors = 6;

  const PointCloud& cloud_;
  const ExplanationRules& rules_;
  const Executor& executor_;
  NearestPoints nearest_;
  Explanation result_;
  float usualSpacing_ = 0.f;
  float noise_ = 0.f;
  // Filled only for the points that need them
  std::vector<float> spacings_;
  std::vector<double> variations_;
  std::vector<Vector4> explained_;
  std::optional<NearestPoints> nearestExplained_; ///< of them
};
}

std::string_view name(Reason reason)
{
  constexpr std::array<std::string_view, Reasons> Names{ "explained", "outlier", "small piece",
    "unreachable", "dropped" };
  return Names[std::size_t(reason)];
}

double Explanation::unexplainedShare() const
{
  const double all = std::accumulate(counts.begin(), counts.end(), 0.) - count(Reason::Dropped);
  return all > 0. ? unexplained() / all : 0.;
}

Explanation explain(const PointCloud& cloud, PointDistances distances,
  const ExplanationRules& rules, const Executor& executor)
{
  return Explainer(cloud, std::move(distances), rules, executor).run();
}
}
