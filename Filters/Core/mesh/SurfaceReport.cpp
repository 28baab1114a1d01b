// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceReport.h"

#include "base/DisjointSets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

namespace neuralmesh
{
namespace
{
using Index = std::uint32_t;

const double FoldedCosine = std::cos(150. * std::numbers::pi / 180.);

/// An edge as one triangle sees it, in 16 bytes, as there are six a vertex. Corner 3 t + k is the k-th of triangle t.
struct EdgeSide
{
  Index low;
  Index high;
  std::uint64_t from : 63; ///< the corner at which the triangle begins it
  std::uint64_t up : 1;    ///< whether the triangle runs from low to high

  std::size_t triangle() const { return from / 3; }
  bool isUpwards() const { return up != 0; }
  std::size_t cornerAtLow() const { return isUpwards() ? from : to(); }
  std::size_t cornerAtHigh() const { return isUpwards() ? to() : from; }
  bool isSameEdge(const EdgeSide& other) const { return low == other.low && high == other.high; }

private:
  std::size_t to() const { return from % 3 < 2 ? from + 1 : from - 2; }
};
static_assert(sizeof(EdgeSide) == 16);

bool usesPointTwice(const std::array<Index, 3>& triangle)
{
  const auto& [a, b, c] = triangle;
  return a == b || b == c || c == a;
}

Eigen::Vector3d twiceAreaNormal(const TriangleMesh& mesh, std::size_t t)
{
  const auto& [a, b, c] = mesh.triangles[t];
  return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

/// Below it a triangle is nearly a line.
constexpr double SliverQuality = 0.1;

/// Twice the inradius over the circumradius.
double quality(double twiceArea, double a, double b, double c)
{
  return 4. * twiceArea * twiceArea / ((a + b + c) * a * b * c);
}

class Reporter
{
public:
  explicit Reporter(const TriangleMesh& mesh)
    : mesh_(mesh)
    , fans_(3 * mesh.triangles.size())
    , pieces_(mesh.triangles.size())
    , faces_(2 * mesh.triangles.size())
    , valences_(mesh.points.size(), 0)
    , isOnBoundary_(mesh.points.size(), false)
  {
  }

  SurfaceReport report()
  {
    reportPoints();
    reportGeometry();
    visitEdges();
    reportVertices();
    reportComponents();
    return report_;
  }

private:
  void reportPoints()
  {
    report_.triangles = mesh_.triangles.size();
    report_.nonFinitePoints = std::size_t(std::count_if(mesh_.points.begin(), mesh_.points.end(),
      [](const Eigen::Vector3d& point) { return !point.allFinite(); }));
  }

  void reportGeometry()
  {
    Eigen::AlignedBox3d box;
    double volume = 0., qualities = 0.;
    std::optional<Eigen::Vector3d> origin; // near the mesh, for the precision of the volume
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const auto& [ia, ib, ic] = mesh_.triangles[t];
      const Eigen::Vector3d &a = mesh_.points[ia], &b = mesh_.points[ib], &c = mesh_.points[ic];
      const Eigen::Vector3d normal = twiceAreaNormal(mesh_, t);
      const double twiceArea = normal.norm();
      if (!(twiceArea > 0.))
      {
        report_.degenerateTriangles += twiceArea == 0.;
        report_.slivers += twiceArea == 0.;
        continue;
      }
      origin = origin.value_or(a);
      box.extend(a).extend(b).extend(c);
      report_.area += twiceArea / 2.;
      volume += normal.dot(a - *origin) / 6.;
      const double ratio = quality(twiceArea, (a - b).norm(), (b - c).norm(), (c - a).norm());
      qualities += ratio;
      report_.slivers += ratio < SliverQuality;
    }
    volume_ = volume;
    report_.meanQuality = qualities / double(std::max<std::size_t>(1, report_.triangles));
    report_.diagonal = box.isEmpty() ? 0. : box.diagonal().norm();
  }

  /// Calls `use` for every side of the triangles.
  template <typename Use>
  void forEachSide(Use use) const
  {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      const auto& triangle = mesh_.triangles[t];
      for (std::size_t k = 0; k < 3 && !usesPointTwice(triangle); ++k)
      {
        const std::size_t next = (k + 1) % 3;
        const bool upwards = triangle[k] < triangle[next];
        const auto [low, high] = std::minmax(triangle[k], triangle[next]);
        use(EdgeSide{ low, high, 3 * t + k, upwards ? 1u : 0u });
      }
    }
  }

  /// All sides, those of an edge one behind the other: in buckets by the lower point, then sorted.
  std::vector<EdgeSide> sortedSides() const
  {
    std::vector<std::size_t> ends(mesh_.points.size() + 1, 0);
    forEachSide([&](const EdgeSide& side) { ++ends[side.low + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<EdgeSide> sides(ends.back());
    forEachSide([&](const EdgeSide& side) { sides[ends[side.low]++] = side; });
    auto begin = sides.begin();
    for (std::size_t point = 0; point < mesh_.points.size(); ++point)
    {
      const auto end = sides.begin() + std::ptrdiff_t(ends[point]);
      std::sort(begin, end, [](const EdgeSide& a, const EdgeSide& b) { return a.high < b.high; });
      begin = end;
    }
    return sides;
  }

  void visitEdges()
  {
    const std::vector<EdgeSide> sides = sortedSides();
    for (auto first = sides.begin(); first != sides.end();)
    {
      const auto last = std::find_if(
        first, sides.end(), [&](const EdgeSide& side) { return !side.isSameEdge(*first); });
      visitEdge({ first, last });
      first = last;
    }
  }

  void visitEdge(std::span<const EdgeSide> sides)
  {
    const EdgeSide& first = sides.front();
    ++edges_;
    ++valences_[first.low];
    ++valences_[first.high];
    for (const EdgeSide& side : sides)
    {
      fans_.join(first.cornerAtLow(), side.cornerAtLow());
      fans_.join(first.cornerAtHigh(), side.cornerAtHigh());
      pieces_.join(first.triangle(), side.triangle());
    }
    if (sides.size() == 1)
    {
      boundary_.push_back(first);
      isOnBoundary_[first.low] = true;
      isOnBoundary_[first.high] = true;
    }
    else if (sides.size() == 2)
    {
      visitInnerEdge(first, sides.back());
    }
    else
    {
      ++report_.nonManifoldEdges;
    }
  }

  void visitInnerEdge(const EdgeSide& one, const EdgeSide& other)
  {
    const bool consistent = one.isUpwards() != other.isUpwards();
    report_.inconsistentEdges += !consistent;
    // The front of one triangle goes over into the front of the other, or into its back.
    const std::size_t turn = consistent ? 0 : 1;
    faces_.join(2 * one.triangle(), 2 * other.triangle() + turn);
    faces_.join(2 * one.triangle() + 1, 2 * other.triangle() + 1 - turn);

    const Eigen::Vector3d a = twiceAreaNormal(mesh_, one.triangle());
    const Eigen::Vector3d b = (consistent ? 1. : -1.) * twiceAreaNormal(mesh_, other.triangle());
    report_.foldedEdges += a.dot(b) < FoldedCosine * a.norm() * b.norm();
  }

  void reportVertices()
  {
    std::size_t regular = 0;
    for (std::size_t v = 0; v < valences_.size(); ++v)
    {
      const std::size_t valence = valences_[v];
      if (valence > 0)
      {
        ++report_.vertices;
        ++report_.valences[valence];
        regular += valence == (isOnBoundary_[v] ? 4 : 6);
      }
    }
    report_.unusedPoints = mesh_.points.size() - report_.vertices;
    report_.regularRatio = double(regular) / double(std::max<std::size_t>(1, report_.vertices));
    reportFans();
  }

  void reportFans()
  {
    std::vector<unsigned char> fansAt(mesh_.points.size(), 0);
    for (std::size_t corner = 0; corner < 3 * mesh_.triangles.size(); ++corner)
    {
      const auto& triangle = mesh_.triangles[corner / 3];
      unsigned char& fans = fansAt[triangle[corner % 3]];
      if (!usesPointTwice(triangle) && fans_.root(corner) == corner && fans < 2)
      {
        report_.nonManifoldVertices += ++fans == 2;
      }
    }
  }

  void reportComponents()
  {
    bool orientable = true;
    std::size_t triangles = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      if (!usesPointTwice(mesh_.triangles[t]))
      {
        ++triangles;
        report_.components += pieces_.root(t) == t;
        orientable = orientable && !faces_.areJoined(2 * t, 2 * t + 1);
      }
    }
    reportBoundary();
    const SurfaceReport& report = report_;
    if (triangles > 0 && report.isEdgeManifold() && report.isVertexManifold() && orientable)
    {
      const long characteristic = long(report.vertices) - long(edges_) + long(triangles);
      report_.genus = long(report.components) - (characteristic + long(report.boundaryLoops)) / 2;
    }
    if (triangles > 0 && report.isClosed() && report.isOriented())
    {
      report_.volume = volume_;
    }
  }

  /// Boundary edges follow each other where they end in the same fan.
  void reportBoundary()
  {
    report_.boundaryEdges = boundary_.size();
    DisjointSets loops(fans_);
    for (const EdgeSide& side : boundary_)
    {
      loops.join(side.cornerAtLow(), side.cornerAtHigh());
    }
    std::vector<std::size_t> roots;
    roots.reserve(boundary_.size());
    for (const EdgeSide& side : boundary_)
    {
      roots.push_back(loops.root(side.cornerAtLow()));
    }
    std::sort(roots.begin(), roots.end());
    report_.boundaryLoops =
      std::size_t(std::distance(roots.begin(), std::unique(roots.begin(), roots.end())));
  }

  const TriangleMesh& mesh_;
  DisjointSets fans_;   ///< corners that are connected by edges at their vertex
  DisjointSets pieces_; ///< triangles
  DisjointSets faces_;  ///< fronts (even) and backs (odd) of triangles
  std::vector<std::size_t> valences_;
  std::vector<bool> isOnBoundary_;
  std::vector<EdgeSide> boundary_;
  std::size_t edges_ = 0;
  double volume_ = 0.;
  SurfaceReport report_;
};
}

SurfaceReport reportSurface(const TriangleMesh& mesh) { return Reporter(mesh).report(); }
}
