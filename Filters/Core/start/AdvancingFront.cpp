// SPDX-License-Identifier: BSD-3-Clause
#include "start/AdvancingFront.h"

#include "mesh/Delaunay.h"
#include "start/LayersApart.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The circle of a triangle, at most, against the mean radius of its samples.
constexpr double LargestCircle = 3.;
/// Where the surface bends by more, candidates wait: cosine of 30 degrees.
constexpr double CosineOfSmooth = 0.866;
/// A candidate that lies back on its triangle is none: cosine of 150 degrees.
constexpr double CosineOfFold = -0.866;
/// A candidate that bends has a ball at most so much larger than that of the triangle.
constexpr double LargestGrowth = 5.;

/// Against the distance: between samples whose normals are the same.
constexpr float LargestRise = 0.3f;
constexpr float ErrorsOfRise = 3.f;
/// Of the radius of a sample: it was moved away from another layer.
constexpr float LeastWay = 0.1f;

/// Of a triangle and the way of a sample away from another layer: cosine that tells to which side it looks.
constexpr double CosineOfSide = 0.5;
/// That is so sure as it is close by: what is left of it in the next triangle, and how little is nothing.
constexpr double SideLeft = 0.8;
constexpr double LeastSide = 0.2;

constexpr double None = std::numeric_limits<double>::infinity();

/// A triangle of the Delaunay cells: opposite to a vertex of one.
struct Facet
{
  std::int32_t cell = -1;
  std::int32_t index = 0;
};

/// The Delaunay cells of the samples, and the radii of the empty balls of their triangles.
class Facets
{
public:
  explicit Facets(std::span<const LayerSample> samples)
    : samples_(samples)
    , delaunay_(positionsOf(samples))
    , centers_(delaunay_.cells().size())
  {
    for (std::size_t i = 0; i < centers_.size(); ++i)
    {
      if (!delaunay_.cells()[i].isOutside())
      {
        centers_[i] = centerOf(delaunay_.cells()[i]);
      }
    }
  }

  const std::vector<Delaunay::Cell>& cells() const { return delaunay_.cells(); }
  /// On the grid of the cells.
  Eigen::Vector3d position(std::int32_t v) const { return delaunay_.onGrid(v); }

  /// The radius of the smallest ball through the corners of a triangle that holds no sample, in cells of
  /// the grid; None if the triangle is too large for its samples.
  double radius(Facet facet) const
  {
    const Delaunay::Cell& cell = cells()[std::size_t(facet.cell)];
    const auto [a, b, c] = Delaunay::facet(cell, facet.index);
    const Eigen::Vector3d u = position(b) - position(a), v = position(c) - position(a);
    const Eigen::Vector3d normal = u.cross(v);
    const double squared = normal.squaredNorm();
    if (!(squared > 0.))
    {
      return None;
    }
    const double circle =
      0.5 * std::sqrt(u.squaredNorm() * v.squaredNorm() * (u - v).squaredNorm() / squared);
    const double size = double(samples_[std::size_t(a)].radius + samples_[std::size_t(b)].radius +
                          samples_[std::size_t(c)].radius) /
      (3. * delaunay_.gridWidth());
    if (!(circle <= LargestCircle * size))
    {
      return None;
    }
    // The centers of empty balls lie between those of the two cells: if these are on the two sides of
    // the triangle, the smallest ball is that of its circle.
    const std::int32_t other = cell.neighbors[std::size_t(facet.index)];
    const double side = sideOf(facet.cell, a, normal, true);
    const double otherSide = sideOf(other, a, normal, false);
    if (side >= 0. && otherSide <= 0.)
    {
      return circle;
    }
    const std::int32_t nearer = side < 0. ? facet.cell : other;
    return (centers_[std::size_t(nearer)] - position(a)).norm();
  }

  /// Whether two samples lie in one layer as far as their normals tell: the way from the one to the other
  /// rises above the planes of both no more than these differ.
  bool areInOneLayer(std::int32_t a, std::int32_t b) const
  {
    const LayerSample &p = samples_[std::size_t(a)], &q = samples_[std::size_t(b)];
    if (squaredNorm(p.normal) == 0.f || squaredNorm(q.normal) == 0.f)
    {
      return true;
    }
    const Vector4 way = q.position - p.position;
    const float rise = std::max(std::abs(dot(way, p.normal)), std::abs(dot(way, q.normal)));
    const float turn = std::sqrt(squaredNorm(cross(p.normal, q.normal)));
    const float length = std::sqrt(squaredNorm(way));
    return rise <= length * (LargestRise + turn) + ErrorsOfRise * (p.error + q.error);
  }

private:
  static std::vector<Vector4> positionsOf(std::span<const LayerSample> samples)
  {
    std::vector<Vector4> positions(samples.size());
    std::transform(samples.begin(), samples.end(), positions.begin(),
      [](const LayerSample& sample) { return sample.position; });
    return positions;
  }

  /// Of the center of a cell's ball, to a triangle; of what is outside, as far as one likes.
  double sideOf(
    std::int32_t cell, std::int32_t corner, const Eigen::Vector3d& normal, bool isInFront) const
  {
    if (cells()[std::size_t(cell)].isOutside())
    {
      return isInFront ? None : -None;
    }
    return normal.dot(centers_[std::size_t(cell)] - position(corner));
  }

  Eigen::Vector3d centerOf(const Delaunay::Cell& cell) const
  {
    Eigen::Vector3d a = position(cell.vertices[0]);
    const Eigen::Vector3d u = position(cell.vertices[1]) - a, v = position(cell.vertices[2]) - a,
                          w = position(cell.vertices[3]) - a;
    const Eigen::Vector3d uv = u.cross(v);
    const double volume = 2. * uv.dot(w);
    if (!(std::abs(volume) > 0.))
    {
      return a;
    }
    return a +
      (w.squaredNorm() * uv + v.squaredNorm() * w.cross(u) + u.squaredNorm() * v.cross(w)) / volume;
  }

  std::span<const LayerSample> samples_;
  Delaunay delaunay_;
  std::vector<Eigen::Vector3d> centers_;
};

/// Grows the surface.
class AdvancingFront
{
public:
  /// `ways` are those of the samples, away from another layer beside theirs; none if layers are joined.
  AdvancingFront(const Facets& facets, std::size_t sampleCount, std::span<const Vector4> ways)
    : facets_(facets)
    , ways_(ways)
    , firstEdge_(sampleCount, NoEdge)
    , openEdges_(sampleCount, 0)
    , keepsToLayers_(!ways.empty())
  {
  }

  std::vector<std::array<std::uint32_t, 3>> run()
  {
    for (const Seed& seed : seeds())
    {
      const auto corners = cornersOf(seed);
      const bool isFree = std::all_of(
        corners.begin(), corners.end(), [&](std::int32_t v) { return !isOnSurface(v); });
      const auto [a, b, c] = corners;
      if (isFree &&
        (!keepsToLayers_ ||
          (facets_.areInOneLayer(a, b) && facets_.areInOneLayer(b, c) &&
            facets_.areInOneLayer(c, a))))
      {
        addTriangle(corners, seed.facet, seed.radius, 0.);
        advance();
      }
    }
    // Rims of plates, where one layer goes over into the other.
    keepsToLayers_ = false;
    for (std::uint32_t edge = 0; edge < edges_.size(); ++edge)
    {
      propose(edge);
    }
    advance();
    return std::move(triangles_);
  }

private:
  static constexpr std::uint32_t NoEdge = ~0u;

  struct Seed
  {
    double radius;
    Facet facet;
    /// 1 if it looks away from another layer, -1 if it looks to that, 0 if its samples do not tell.
    double side = 0.;
  };

  /// A directed edge of a triangle. It belongs to the front as long as the triangle on its other side is
  /// missing.
  struct Edge
  {
    std::int32_t from, to;
    std::int32_t apex; ///< of its triangle
    std::uint32_t nextAtFrom;
    Facet facet; ///< of its triangle
    double radius;
    bool isOpen;
    /// The side of its triangle, or of one a few triangles away; fading to 0, which is unknown.
    double side = 0.;
  };

  /// The triangle with which the front would go on at an edge. The classes come one after another.
  enum class Class
  {
    Smooth,
    Bend
  };
  struct Candidate
  {
    Class order;
    double value; ///< the lower, the earlier
    std::uint32_t edge;
    std::int32_t apex;
    Facet facet;
    double radius;

    bool operator>(const Candidate& other) const
    {
      return std::tie(order, value, edge) > std::tie(other.order, other.value, other.edge);
    }
  };

  std::vector<Seed> seeds() const
  {
    std::vector<Seed> result;
    const auto& cells = facets_.cells();
    for (std::int32_t cell = 0; cell < std::int32_t(cells.size()); ++cell)
    {
      for (std::int32_t index = 0; index < 4; ++index)
      {
        const Facet facet{ cell, index };
        const auto [a, b, c] = cornersOf(facet);
        const bool isFinite = std::min({ a, b, c }) != Delaunay::Outside;
        if (isFinite && cell < cells[std::size_t(cell)].neighbors[std::size_t(index)])
        {
          const double radius = facets_.radius(facet);
          if (radius < None)
          {
            result.push_back({ radius, facet, sideOf(cornersOf(facet)) });
          }
        }
      }
    }
    std::sort(result.begin(), result.end(),
      [](const Seed& a, const Seed& b)
      {
        const bool isATold = a.side != 0., isBTold = b.side != 0.;
        return std::tie(isBTold, a.radius, a.facet.cell, a.facet.index) <
          std::tie(isATold, b.radius, b.facet.cell, b.facet.index);
      });
    return result;
  }

  /// Layers beside each other look away from each other, as the sides of a plate do, or to each other: they
  /// could not be joined at their rims else. So seeds come first whose samples tell that, and where it is
  /// told the surface keeps to it.
  double sideOf(const std::array<std::int32_t, 3>& corners) const
  {
    if (ways_.empty())
    {
      return 0.;
    }
    const auto [a, b, c] = corners;
    const Eigen::Vector3d normal = (facets_.position(b) - facets_.position(a))
                                     .cross(facets_.position(c) - facets_.position(a))
                                     .normalized();
    double least = 0., most = 0.;
    for (const std::int32_t corner : corners)
    {
      const double along = normal.dot(ways_[std::size_t(corner)].toDouble());
      least = std::min(least, along);
      most = std::max(most, along);
    }
    return most > CosineOfSide && least > -CosineOfSide ? 1.
      : least < -CosineOfSide && most < CosineOfSide    ? -1.
                                                        : 0.;
  }

  std::array<std::int32_t, 3> cornersOf(const Seed& seed) const
  {
    auto corners = cornersOf(seed.facet);
    if (seed.side < 0.)
    {
      std::swap(corners[1], corners[2]);
    }
    return corners;
  }

  std::array<std::int32_t, 3> cornersOf(Facet facet) const
  {
    return Delaunay::facet(facets_.cells()[std::size_t(facet.cell)], facet.index);
  }

  bool isOnSurface(std::int32_t v) const { return firstEdge_[std::size_t(v)] != NoEdge; }
  bool isOnFront(std::int32_t v) const { return openEdges_[std::size_t(v)] > 0; }

  std::uint32_t find(std::int32_t from, std::int32_t to) const
  {
    std::uint32_t edge = firstEdge_[std::size_t(from)];
    while (edge != NoEdge && edges_[edge].to != to)
    {
      edge = edges_[edge].nextAtFrom;
    }
    return edge;
  }
  bool isOpen(std::int32_t from, std::int32_t to) const
  {
    const std::uint32_t edge = find(from, to);
    return edge != NoEdge && edges_[edge].isOpen;
  }

  /// `sideBefore` is the side of the triangle beside it.
  void addTriangle(
    const std::array<std::int32_t, 3>& corners, Facet facet, double radius, double sideBefore)
  {
    const double own = sideOf(corners);
    const double side = own != 0.        ? own
      : std::abs(sideBefore) > LeastSide ? SideLeft * sideBefore
                                         : 0.;
    triangles_.push_back(
      { std::uint32_t(corners[0]), std::uint32_t(corners[1]), std::uint32_t(corners[2]) });
    std::array<std::uint32_t, 3> added;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int32_t from = corners[i], to = corners[(i + 1) % 3], apex = corners[(i + 2) % 3];
      const std::uint32_t twin = find(to, from);
      const bool isOpen = twin == NoEdge;
      if (isOpen)
      {
        ++openEdges_[std::size_t(from)];
        ++openEdges_[std::size_t(to)];
      }
      else
      {
        edges_[twin].isOpen = false;
        --openEdges_[std::size_t(from)];
        --openEdges_[std::size_t(to)];
      }
      added[i] = std::uint32_t(edges_.size());
      edges_.push_back(
        { from, to, apex, firstEdge_[std::size_t(from)], facet, radius, isOpen, side });
      firstEdge_[std::size_t(from)] = added[i];
    }
    for (const std::uint32_t edge : added)
    {
      propose(edge);
    }
  }

  /// Puts the best candidate of an edge into the queue.
  void propose(std::uint32_t edge)
  {
    if (edges_[edge].isOpen)
    {
      if (const auto candidate = bestAt(edge))
      {
        queue_.push(*candidate);
      }
    }
  }

  /// Whether a triangle on the other side of the edge would keep the surface a manifold.
  bool isAllowed(const Edge& edge, std::int32_t apex) const
  {
    return !isOnSurface(apex) ||
      (isOnFront(apex) && find(edge.from, apex) == NoEdge && find(apex, edge.to) == NoEdge);
  }
  /// Whether the apex has no edge in common with the edge, but is on the front.
  bool isBridge(const Edge& edge, std::int32_t apex) const
  {
    return isOnSurface(apex) && !isOpen(apex, edge.from) && !isOpen(edge.to, apex);
  }

  template <typename Use>
  void forEachFacetAt(const Edge& edge, Use use) const
  {
    // Round the edge, from cell to cell.
    std::int32_t cell = edge.facet.cell;
    std::int32_t entered = edge.apex;
    const std::int32_t first = cell;
    do
    {
      const Delaunay::Cell& c = facets_.cells()[std::size_t(cell)];
      std::int32_t index = 0;
      while (c.vertices[std::size_t(index)] == edge.from ||
        c.vertices[std::size_t(index)] == edge.to || c.vertices[std::size_t(index)] == entered)
      {
        ++index;
      }
      // The facet that is left through is opposite to the vertex of the one that was entered through.
      const std::int32_t apex = c.vertices[std::size_t(index)];
      const std::int32_t opposite = std::int32_t(c.indexOf(entered));
      if (apex != Delaunay::Outside)
      {
        use(apex, Facet{ cell, opposite });
      }
      entered = apex;
      cell = c.neighbors[std::size_t(opposite)];
    } while (cell != first);
  }

  std::optional<Candidate> bestAt(std::uint32_t index) const
  {
    const Edge& edge = edges_[index];
    const Eigen::Vector3d from = facets_.position(edge.from);
    const Eigen::Vector3d along = facets_.position(edge.to) - from;
    const Eigen::Vector3d normal = along.cross(facets_.position(edge.apex) - from).normalized();
    Candidate best{ Class::Bend, None, index, -1, {}, None };
    double bestCosine = 0.;
    forEachFacetAt(edge,
      [&](std::int32_t apex, Facet facet)
      {
        if (apex == edge.apex || !isAllowed(edge, apex) ||
          (keepsToLayers_ &&
            !(facets_.areInOneLayer(edge.from, apex) && facets_.areInOneLayer(edge.to, apex))))
        {
          return;
        }
        const double radius = facets_.radius(facet);
        if (!(radius < best.radius))
        {
          return;
        }
        const double cosine = normal.dot((facets_.position(apex) - from).cross(along).normalized());
        if (cosine > CosineOfFold && !(edge.side * sideOf({ edge.to, edge.from, apex }) < 0.))
        {
          best.apex = apex;
          best.facet = facet;
          best.radius = radius;
          bestCosine = cosine;
        }
      });
    if (best.apex < 0)
    {
      return {};
    }
    if (bestCosine > CosineOfSmooth)
    {
      best.order = Class::Smooth;
      best.value = best.radius;
    }
    else if (best.radius < LargestGrowth * edge.radius)
    {
      best.value = -bestCosine;
    }
    else
    {
      return {};
    }
    return best;
  }

  /// Whether the front would go on from a bridge by closing the corner beside it: then it is no chance
  /// meeting.
  bool leadsToCorner(const Candidate& candidate)
  {
    const Edge edge = edges_[candidate.edge];
    const std::int32_t apex = candidate.apex;
    for (const bool isAtFrom : { true, false })
    {
      // The new edges of the triangle from-apex-to, seen from it.
      const Edge side{ isAtFrom ? edge.from : apex, isAtFrom ? apex : edge.to,
        isAtFrom ? edge.to : edge.from, NoEdge, candidate.facet, candidate.radius, true };
      edges_.push_back(side);
      const auto next = bestAt(std::uint32_t(edges_.size() - 1));
      edges_.pop_back();
      if (next && next->order == Class::Smooth &&
        (isOpen(apex, next->apex) || isOpen(next->apex, apex)))
      {
        return true;
      }
    }
    return false;
  }

  void advance()
  {
    std::size_t before;
    do
    {
      before = triangles_.size();
      advanceOnce();
      for (const std::uint32_t edge : std::exchange(waiting_, {}))
      {
        propose(edge);
      }
    } while (triangles_.size() > before);
    queue_ = {};
  }

  void advanceOnce()
  {
    while (!queue_.empty())
    {
      const Candidate candidate = queue_.top();
      queue_.pop();
      const Edge edge = edges_[candidate.edge];
      if (!edge.isOpen)
      {
        continue;
      }
      if (!isAllowed(edge, candidate.apex))
      {
        propose(candidate.edge);
        continue;
      }
      if (isBridge(edge, candidate.apex) && !leadsToCorner(candidate))
      {
        // Perhaps once more of the front is there.
        waiting_.push_back(candidate.edge);
        continue;
      }
      addTriangle(
        { edge.to, edge.from, candidate.apex }, candidate.facet, candidate.radius, edge.side);
    }
  }

  const Facets& facets_;
  std::span<const Vector4> ways_;
  std::vector<std::uint32_t> firstEdge_; ///< that begins at a sample
  std::vector<std::uint32_t> openEdges_; ///< that begin or end there
  std::vector<Edge> edges_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
  bool keepsToLayers_;
  std::vector<std::uint32_t> waiting_; ///< edges whose candidates are bridges to nowhere
  std::vector<std::array<std::uint32_t, 3>> triangles_;
};
}

std::vector<std::array<std::uint32_t, 3>> advancingFront(
  std::span<const LayerSample> samples, Layers layers)
{
  if (layers == Layers::Joined)
  {
    const Facets facets(samples);
    return AdvancingFront(facets, samples.size(), {}).run();
  }
  const std::vector<LayerSample> moved = layersApart(samples);
  std::vector<Vector4> ways(samples.size());
  std::transform(moved.begin(), moved.end(), samples.begin(), ways.begin(),
    [](const LayerSample& to, const LayerSample& from)
    {
      const Vector4 way = to.position - from.position;
      const float length = std::sqrt(squaredNorm(way));
      return length > LeastWay * from.radius ? 1.f / length * way : Vector4();
    });
  const Facets facets(moved);
  return AdvancingFront(facets, samples.size(), ways).run();
}
}
