// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/ShadowSides.h"

#include "cloud/MeshBuilder.h"
#include "cloud/Visibility.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// Of the area: what has no certain side.
constexpr double LeastUncertainArea = 0.5;
/// In circumferences of a disc of the same area.
constexpr double ShortestBoundary = 1.75;
/// Places along boundaries, and on the surface, that are looked at.
constexpr std::size_t RimProbes = 400;
constexpr std::size_t RimProbesOfFirstLook = 150;
constexpr std::size_t SurfaceProbes = 300;
/// From a boundary, in its edges: what lies within the surface, what lies beyond it, and how far in front of either
/// something must be to hide it.
constexpr double Within = 1.;
constexpr double Beyond = 2.5;
constexpr double InFront = 3.;
/// Viewpoints of the first look, along each axis, and how far they reach out of the box, in its diagonals.
constexpr int ViewpointsPerAxis = 7;
constexpr double ReachOfViewpoints = 0.6;
/// The best so many are improved, by steps of these fractions of the diagonal.
constexpr std::size_t ViewpointsImproved = 3;
constexpr double FirstStep = 1. / 4.;
constexpr double LastStep = 1. / 32.;
/// The part of the boundary that ends in shadows, times the part of the surface that is seen from one side.
constexpr double LeastExplained = 0.1;
constexpr double LeastRatio = 2.;
/// The same against the volume.
constexpr double LeastExplainedWithin = 0.2;
constexpr double LeastRatioWithin = 5.;
constexpr double ShortestBoundaryWithin = 0.25;
/// Of the angle between the way to a boundary and the normal there: along a corridor, a rough wall hides itself.
constexpr double LeastCosineWithin = 0.25;
/// The same for a doubt: at the rim of a mask it hides itself, too.
constexpr double LeastCosineInDoubt = 0.2;
/// What a first look from within must explain, from so many places along each axis of the box.
constexpr double LeastAtFirstLook = 0.08;
constexpr int PlacesWithinPerAxis = 3;
/// Of the area: smaller pieces are no rooms.
constexpr double LeastHull = 0.2;

/// At a boundary.
struct RimProbe
{
  Eigen::Vector3d within;
  Eigen::Vector3d beyond;
  Eigen::Vector3d normal;
};

/// On the surface; each stands for the same area.
struct SurfaceProbe
{
  Eigen::Vector3d place;
  Eigen::Vector3d normal;
  std::size_t piece;
};

/// What shadows tell.
struct Shadows
{
  std::vector<int>
    directions; ///< of each piece: 1 towards the scanner, -1 away from it, 0 if that is unknown
  double explained = 0.;
  double opposite = 0.;  ///< what a place explains that sees the other sides
  bool isWithin = false; ///< whether the scanner was in the bounding box

  bool tell(double leastExplained, double leastRatio) const
  {
    return explained >= leastExplained && explained >= leastRatio * opposite;
  }
};

/// What is seen from a place.
struct View
{
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  double shadow = 0.;              ///< the part of the boundary behind which the surface is hidden
  std::vector<std::int8_t> facing; ///< of each probe: 1 towards it, -1 away, 0 where it is hidden
};

class ShadowSearch
{
public:
  /// Only pieces that are asked cast shadows, or have gaps.
  template <typename IsAsked>
  ShadowSearch(const Mesh& mesh, std::span<const Piece> pieces, const IsAsked& isAsked,
    const PointCloud& cloud, const Executor& executor)
    : isAsked_(mesh.indexEnd(), false)
    , surface_(askedTriangles(mesh, pieces, isAsked, cloud, executor))
    , visibility_(surface_)
    , executor_(executor)
    , pieceCount_(pieces.size())
  {
    for (std::size_t v = 0; v < surface_.points.size(); ++v)
    {
      if (isAsked_[v])
      {
        bounds_.extend(surface_.points[v]);
      }
    }
    addRimProbes(mesh);
    addSurfaceProbes(mesh, pieces);
  }

  /// From now on, gaps that are seen with a smaller cosine count as none.
  void leaveOutGrazing(double leastCosine) { leastCosine_ = leastCosine; }

  /// Whether places spread in the bounding box explain anything: most scans are done with so.
  bool mayBeFromWithin() const
  {
    std::vector<Eigen::Vector3d> places;
    addGrid(PlacesWithinPerAxis, 0.25 * bounds_.diagonal(), places);
    const std::vector<View> views = lookFrom(places, RimProbesOfFirstLook);
    return std::any_of(views.begin(), views.end(),
      [this](const View& view) { return explainedBy(view) >= LeastAtFirstLook; });
  }

  Shadows shadows() const
  {
    const std::vector<View> views = firstLook();
    const auto plain = [this](const View& view) { return explainedBy(view); };
    const View best = bestOf(views, plain);
    Shadows result{ directionsIn(best), 0., 0., bounds_.contains(best.viewpoint) };
    const auto opposite = [&](const View& view) { return -agreement(view, result.directions); };
    result.explained = agreement(best, result.directions);
    result.opposite = opposite(bestOf(views, opposite));
    return result;
  }

private:
  template <typename IsAsked>
  TriangleMesh askedTriangles(const Mesh& mesh, std::span<const Piece> pieces,
    const IsAsked& isAsked, const PointCloud& cloud, const Executor& executor)
  {
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      for (const VertexIndex v : pieces[i].vertices)
      {
        isAsked_[v] = isAsked(i);
      }
    }
    TriangleMesh result = trianglesOf(mesh, cloud, executor);
    std::erase_if(
      result.triangles, [this](const auto& triangle) { return !isAsked_[triangle[0]]; });
    return result;
  }

  void addRimProbes(const Mesh& mesh)
  {
    std::vector<VertexIndex> rim;
    double length = 0.;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (isAsked_[v] && mesh.isBoundary(v))
      {
        rim.push_back(v);
        length += (surface_.points[mesh.ring(v)[0]] - surface_.points[v]).norm();
      }
    }
    edge_ = length / double(rim.size());
    const std::size_t count = std::min(rim.size(), RimProbes);
    for (std::size_t i = 0; i < count; ++i)
    {
      // Spread over all of the boundary, whichever come first.
      const VertexIndex v = rim[(i * Spread % count) * rim.size() / count];
      const Eigen::Vector3d &a = surface_.points[v], &b = surface_.points[mesh.ring(v)[0]],
                            &c = surface_.points[mesh.ring(v)[1]];
      const Eigen::Vector3d normal = (b - a).cross(c - a);
      const Eigen::Vector3d outwards = (b - a).cross(normal).normalized();
      const Eigen::Vector3d middle = 0.5 * (a + b);
      rimProbes_.push_back({ middle - Within * edge_ * outwards, middle + Beyond * edge_ * outwards,
        normal.normalized() });
    }
  }

  void addSurfaceProbes(const Mesh& mesh, std::span<const Piece> pieces)
  {
    double area = 0.;
    for (const Piece& piece : pieces)
    {
      area += piece.area;
    }
    double passed = 0.;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      for (const VertexIndex v : pieces[i].vertices)
      {
        if (!isAsked_[v])
        {
          break;
        }
        mesh.forEachTriangleFrom(v,
          [&](VertexIndex a, VertexIndex b, VertexIndex c)
          {
            passed += areaOf(mesh, { a, b, c });
            if (passed * double(SurfaceProbes) > (double(surfaceProbes_.size()) + 0.5) * area)
            {
              const Eigen::Vector3d &p = surface_.points[a], &q = surface_.points[b],
                                    &r = surface_.points[c];
              surfaceProbes_.push_back({ (p + q + r) / 3., (q - p).cross(r - p), i });
            }
          });
      }
    }
  }

  bool isHidden(const Eigen::Vector3d& place, const Eigen::Vector3d& viewpoint) const
  {
    return visibility_.isHidden(place, viewpoint, InFront * edge_);
  }

  View lookFrom(const Eigen::Vector3d& viewpoint, std::size_t rimProbes) const
  {
    View view{ viewpoint, 0., std::vector<std::int8_t>(surfaceProbes_.size()) };
    const std::size_t count = std::min(rimProbes, rimProbes_.size());
    for (std::size_t i = 0; i < count; ++i)
    {
      const auto& [within, beyond, normal] = rimProbes_[i];
      const Eigen::Vector3d way = viewpoint - within;
      if (std::abs(normal.dot(way)) < leastCosine_ * way.norm())
      {
        continue;
      }
      const bool isWithin = isHidden(within, viewpoint), isBeyond = isHidden(beyond, viewpoint);
      // As many that are hidden the other way round are chance.
      view.shadow += double(int(isBeyond) - int(isWithin)) / double(count);
    }
    for (std::size_t i = 0; i < surfaceProbes_.size(); ++i)
    {
      const auto& [place, normal, piece] = surfaceProbes_[i];
      const bool isTowards = normal.dot(viewpoint - place) > 0.;
      view.facing[i] = std::int8_t(isHidden(place, viewpoint) ? 0 : isTowards ? 1 : -1);
    }
    return view;
  }

  std::vector<View> lookFrom(std::span<const Eigen::Vector3d> places, std::size_t rimProbes) const
  {
    std::vector<View> views(places.size());
    executor_.forEachPart(
      places.size(), [&](std::size_t i) { views[i] = lookFrom(places[i], rimProbes); });
    return views;
  }

  /// From the origin, if it is not far off, and from a grid.
  std::vector<View> firstLook() const
  {
    const double diagonal = bounds_.diagonal().norm();
    const Eigen::Vector3d reach =
      0.5 * bounds_.diagonal() + Eigen::Vector3d::Constant(ReachOfViewpoints * diagonal);
    std::vector<Eigen::Vector3d> places;
    if (bounds_.squaredExteriorDistance(Eigen::Vector3d::Zero()) < diagonal * diagonal)
    {
      places.push_back(Eigen::Vector3d::Zero());
    }
    addGrid(ViewpointsPerAxis, reach, places);
    return lookFrom(places, RimProbesOfFirstLook);
  }

  /// Places around the center, as far as `reach` to each side.
  void addGrid(
    int perAxis, const Eigen::Vector3d& reach, std::vector<Eigen::Vector3d>& places) const
  {
    const auto along = [perAxis](int i) { return 2. * double(i) / double(perAxis - 1) - 1.; };
    for (int i = 0; i < perAxis; ++i)
    {
      for (int j = 0; j < perAxis; ++j)
      {
        for (int k = 0; k < perAxis; ++k)
        {
          const Eigen::Vector3d direction(along(i), along(j), along(k));
          places.emplace_back(bounds_.center() + reach.cwiseProduct(direction));
        }
      }
    }
  }

  /// The best view, by `worthOf`, that steps lead to.
  template <typename WorthOf>
  View bestOf(const std::vector<View>& views, const WorthOf& worthOf) const
  {
    std::vector<double> worths(views.size());
    std::transform(views.begin(), views.end(), worths.begin(), worthOf);
    std::vector<std::size_t> order(views.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return worths[a] > worths[b]; });
    View best;
    for (std::size_t i = 0; i < ViewpointsImproved; ++i)
    {
      View view = improved(views[order[i]].viewpoint, worthOf);
      if (i == 0 || worthOf(view) > worthOf(best))
      {
        best = std::move(view);
      }
    }
    return best;
  }

  template <typename WorthOf>
  View improved(const Eigen::Vector3d& viewpoint, const WorthOf& worthOf) const
  {
    View best = lookFrom(viewpoint, RimProbes);
    const double diagonal = bounds_.diagonal().norm();
    for (double step = FirstStep; step >= LastStep;)
    {
      std::array<Eigen::Vector3d, 6> places;
      for (int i = 0; i < 6; ++i)
      {
        const double way = (i % 2 == 0 ? step : -step) * diagonal;
        places[std::size_t(i)] = best.viewpoint + way * Eigen::Vector3d::Unit(i / 2);
      }
      bool isBetter = false;
      for (View& view : lookFrom(places, RimProbes))
      {
        if (worthOf(view) > worthOf(best))
        {
          best = std::move(view);
          isBetter = true;
        }
      }
      step = isBetter ? step : 0.5 * step;
    }
    return best;
  }

  /// What faces the viewpoint less what looks away, of each piece.
  std::vector<int> sumsIn(const View& view) const
  {
    std::vector<int> sums(pieceCount_, 0);
    for (std::size_t i = 0; i < surfaceProbes_.size(); ++i)
    {
      sums[surfaceProbes_[i].piece] += view.facing[i];
    }
    return sums;
  }

  /// Each piece may be turned by itself.
  double explainedBy(const View& view) const
  {
    const std::vector<int> sums = sumsIn(view);
    const int seen = std::accumulate(
      sums.begin(), sums.end(), 0, [](int sum, int one) { return sum + std::abs(one); });
    return std::max(0., view.shadow) * double(seen) / double(surfaceProbes_.size());
  }

  /// As that, but with these directions; negative if the view is from the other side.
  double agreement(const View& view, const std::vector<int>& directions) const
  {
    const std::vector<int> sums = sumsIn(view);
    const int seen = std::inner_product(sums.begin(), sums.end(), directions.begin(), 0);
    return std::max(0., view.shadow) * double(seen) / double(surfaceProbes_.size());
  }

  std::vector<int> directionsIn(const View& view) const
  {
    const std::vector<int> sums = sumsIn(view);
    std::vector<int> seen(pieceCount_, 0), result(pieceCount_, 0);
    for (std::size_t i = 0; i < surfaceProbes_.size(); ++i)
    {
      seen[surfaceProbes_[i].piece] += std::abs(view.facing[i]);
    }
    for (std::size_t i = 0; i < pieceCount_; ++i)
    {
      result[i] = 2 * std::abs(sums[i]) <= seen[i] ? 0 : sums[i] > 0 ? 1 : -1;
    }
    return result;
  }

  /// A prime number that divides no count of probes.
  static constexpr std::size_t Spread = 1009;

  std::vector<bool> isAsked_; ///< of the vertices
  TriangleMesh surface_;
  Visibility visibility_;
  const Executor& executor_;
  double leastCosine_ = 0.;
  std::size_t pieceCount_;
  Eigen::AlignedBox3d bounds_;
  double edge_ = 0.; ///< the mean one of boundaries
  std::vector<RimProbe> rimProbes_;
  std::vector<SurfaceProbe> surfaceProbes_;
};

/// The length of the boundaries of the pieces that are chosen, in circumferences of a disc of their area.
template <typename IsChosen>
double boundaryOf(const Mesh& mesh, std::span<const Piece> pieces, const IsChosen& isChosen)
{
  double boundary = 0., area = 0.;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    area += isChosen(i) ? pieces[i].area : 0.;
    for (const VertexIndex v : pieces[i].vertices)
    {
      boundary += isChosen(i) && mesh.isBoundary(v)
        ? std::sqrt(double(squaredNorm(mesh.position(mesh.ring(v)[0]) - mesh.position(v))))
        : 0.;
    }
  }
  return area > 0. ? boundary / (2. * std::sqrt(std::numbers::pi * area)) : 0.;
}

/// The part of the area of the pieces that are chosen.
template <typename IsChosen>
double shareOf(std::span<const Piece> pieces, const IsChosen& isChosen)
{
  double area = 0., chosen = 0.;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    area += pieces[i].area;
    chosen += isChosen(i) ? pieces[i].area : 0.;
  }
  return area > 0. ? chosen / area : 0.;
}
}

std::vector<Side> sidesByShadows(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> known, const PointCloud& cloud, const Executor& executor)
{
  std::vector<Side> sides(pieces.size());
  const auto isUncertain = [&](std::size_t i) { return !known[i].isKnown(); };
  const auto isAny = [](std::size_t) { return true; };
  if (shareOf(pieces, isUncertain) < LeastUncertainArea ||
    boundaryOf(mesh, pieces, isAny) < ShortestBoundary)
  {
    return sides;
  }
  const Shadows shadows = ShadowSearch(mesh, pieces, isAny, cloud, executor).shadows();
  const bool doTell = shadows.tell(LeastExplained, LeastRatio);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (doTell && isUncertain(i) && shadows.directions[i] != 0)
    {
      sides[i] = { SideEvidence::Shadows, shadows.directions[i] < 0, true };
    }
  }
  return sides;
}

FromWithin sidesFromWithin(const Mesh& mesh, std::span<const Piece> pieces,
  std::span<const Side> byVolume, const PointCloud& cloud, const Executor& executor)
{
  FromWithin result{ std::vector<Side>(pieces.size()), false };
  std::vector<Side>& sides = result.sides;
  const std::vector<Eigen::AlignedBox3d> boxes = boxesOf(mesh, pieces);
  for (std::size_t hull = 0; hull < pieces.size(); ++hull)
  {
    const auto isHull = [hull](std::size_t i) { return i == hull; };
    if (pieces[hull].isClosed || !byVolume[hull].isKnown() || sides[hull].isKnown() ||
      shareOf(pieces, isHull) < LeastHull)
    {
      continue;
    }
    // Pieces whose volume tells nothing may be a base that was torn off, and lies before its opening.
    const auto isAsked = [&](std::size_t i)
    { return byVolume[i].isKnown() && boxes[hull].contains(boxes[i]); };
    if (boundaryOf(mesh, pieces, isAsked) < ShortestBoundaryWithin)
    {
      continue;
    }
    ShadowSearch search(mesh, pieces, isAsked, cloud, executor);
    Shadows shadows;
    const auto looksAway = [&](std::size_t i)
    { return isAsked(i) && shadows.directions[i] == (byVolume[i].isTurned ? 1 : -1); };
    const auto areFromWithin = [&]
    {
      shadows = search.shadows();
      return shadows.isWithin && shadows.tell(LeastExplainedWithin, LeastRatioWithin) &&
        looksAway(hull);
    };
    if (!search.mayBeFromWithin() || !areFromWithin())
    {
      continue;
    }
    search.leaveOutGrazing(LeastCosineInDoubt);
    if (!search.mayBeFromWithin())
    {
      continue;
    }
    result.isInDoubt = true;
    search.leaveOutGrazing(LeastCosineWithin);
    if (search.mayBeFromWithin() && areFromWithin())
    {
      for (std::size_t i = 0; i < pieces.size(); ++i)
      {
        if (looksAway(i))
        {
          sides[i] = { SideEvidence::Shadows, !byVolume[i].isTurned, true };
        }
      }
    }
  }
  return result;
}
}
