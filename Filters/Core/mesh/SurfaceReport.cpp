// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceReport.h"

#include "base/ConcurrentSets.h"
#include "base/ZeroedArray.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
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

/// Parts for the executor.
constexpr std::size_t ReportedPerRange = 4096;

class Reporter
{
public:
  Reporter(const TriangleMesh& mesh, const Executor& executor)
    : mesh_(mesh)
    , executor_(executor)
    , fans_(3 * mesh.triangles.size(), executor)
    , pieces_(mesh.triangles.size(), executor)
    , faces_(2 * mesh.triangles.size(), executor)
    , valences_(mesh.points.size(), 0)
    , isOnBoundary_(mesh.points.size(), 0)
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
  /// What the edges from a part of the points to those behind them tell.
  struct EdgeCounts
  {
    std::size_t edges = 0, nonManifold = 0, inconsistent = 0, folded = 0;
    std::vector<EdgeSide> boundary;
  };

  void reportPoints()
  {
    report_.triangles = mesh_.triangles.size();
    report_.nonFinitePoints = std::size_t(std::count_if(mesh_.points.begin(), mesh_.points.end(),
      [](const Eigen::Vector3d& point) { return !point.allFinite(); }));
  }

  /// All triangles on all threads, in parts.
  template <typename Body>
  void forEachTriangle(const Body& body) const
  {
    executor_.forEachRange(mesh_.triangles.size(), ReportedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t t = begin; t < end; ++t)
        {
          body(t);
        }
      });
  }

  void reportGeometry()
  {
    // Near the mesh, for the precision of the volume.
    std::optional<Eigen::Vector3d> origin;
    for (std::size_t t = 0; t < mesh_.triangles.size() && !origin; ++t)
    {
      if (twiceAreaNormal(mesh_, t).norm() > 0.)
      {
        origin = mesh_.points[mesh_.triangles[t][0]];
      }
    }
    struct Shape
    {
      double twiceArea, volume, quality;
    };
    ZeroedArray<Shape> shapes(mesh_.triangles.size());
    std::vector<Eigen::AlignedBox3d> boxes(
      (mesh_.triangles.size() + ReportedPerRange - 1) / ReportedPerRange);
    forEachTriangle(
      [&](std::size_t t)
      {
        const auto& [ia, ib, ic] = mesh_.triangles[t];
        const Eigen::Vector3d &a = mesh_.points[ia], &b = mesh_.points[ib], &c = mesh_.points[ic];
        const Eigen::Vector3d normal = twiceAreaNormal(mesh_, t);
        const double twiceArea = normal.norm();
        shapes[t] = { twiceArea, 0., 0. };
        if (twiceArea > 0.)
        {
          boxes[t / ReportedPerRange].extend(a).extend(b).extend(c);
          shapes[t].volume = normal.dot(a - *origin) / 6.;
          shapes[t].quality = quality(twiceArea, (a - b).norm(), (b - c).norm(), (c - a).norm());
        }
      });
    double volume = 0., qualities = 0.;
    for (const Shape& shape : shapes)
    {
      if (!(shape.twiceArea > 0.))
      {
        report_.degenerateTriangles += shape.twiceArea == 0.;
        report_.slivers += shape.twiceArea == 0.;
        continue;
      }
      report_.area += shape.twiceArea / 2.;
      volume += shape.volume;
      qualities += shape.quality;
      report_.slivers += shape.quality < SliverQuality;
    }
    Eigen::AlignedBox3d box;
    for (const Eigen::AlignedBox3d& some : boxes)
    {
      box.extend(some);
    }
    volume_ = volume;
    report_.meanQuality = qualities / double(std::max<std::size_t>(1, report_.triangles));
    report_.diagonal = box.isEmpty() ? 0. : box.diagonal().norm();
  }

  /// Calls `use` for every side of the triangles, on all threads.
  template <typename Use>
  void forEachSide(const Use& use) const
  {
    forEachTriangle(
      [&](std::size_t t)
      {
        const auto& triangle = mesh_.triangles[t];
        for (std::size_t k = 0; k < 3 && !usesPointTwice(triangle); ++k)
        {
          const std::size_t next = (k + 1) % 3;
          const bool upwards = triangle[k] < triangle[next];
          const auto [low, high] = std::minmax(triangle[k], triangle[next]);
          use(EdgeSide{ low, high, 3 * t + k, upwards ? 1u : 0u });
        }
      });
  }

  static std::size_t increased(std::size_t& count)
  {
    return std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
  }

  /// All sides in buckets by the lower point, then those of an edge one behind the other; `ends` is where each bucket
  /// begins.
  void visitEdges()
  {
    const std::size_t points = mesh_.points.size();
    std::vector<std::size_t> ends(points + 1, 0);
    forEachSide([&](const EdgeSide& side) { increased(ends[side.low + 1]); });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    ZeroedArray<EdgeSide> sides(ends.back());
    forEachSide([&](const EdgeSide& side) { sides[increased(ends[side.low])] = side; });
    std::vector<EdgeCounts> counts((points + ReportedPerRange - 1) / ReportedPerRange);
    executor_.forEachRange(points, ReportedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t point = begin; point < end; ++point)
        {
          const std::size_t first = point > 0 ? ends[point - 1] : 0;
          visitEdgesAt(
            std::span(sides.data() + first, ends[point] - first), counts[begin / ReportedPerRange]);
        }
      });
    for (const EdgeCounts& some : counts)
    {
      edges_ += some.edges;
      report_.nonManifoldEdges += some.nonManifold;
      report_.inconsistentEdges += some.inconsistent;
      report_.foldedEdges += some.folded;
      boundary_.insert(boundary_.end(), some.boundary.begin(), some.boundary.end());
    }
  }

  void visitEdgesAt(std::span<EdgeSide> sides, EdgeCounts& counts)
  {
    // Threads have put them here in any order.
    std::sort(sides.begin(), sides.end(),
      [](const EdgeSide& a, const EdgeSide& b)
      { return a.high != b.high ? a.high < b.high : a.from < b.from; });
    for (auto first = sides.begin(); first != sides.end();)
    {
      const auto last = std::find_if(
        first, sides.end(), [&](const EdgeSide& side) { return !side.isSameEdge(*first); });
      visitEdge({ first, last }, counts);
      first = last;
    }
  }

  void visitEdge(std::span<const EdgeSide> sides, EdgeCounts& counts)
  {
    const EdgeSide& first = sides.front();
    ++counts.edges;
    increased(valences_[first.low]);
    increased(valences_[first.high]);
    for (const EdgeSide& side : sides)
    {
      fans_.join(first.cornerAtLow(), side.cornerAtLow());
      fans_.join(first.cornerAtHigh(), side.cornerAtHigh());
      pieces_.join(first.triangle(), side.triangle());
    }
    if (sides.size() == 1)
    {
      counts.boundary.push_back(first);
      for (const Index point : { first.low, first.high })
      {
        std::atomic_ref(isOnBoundary_[point]).store(1, std::memory_order_relaxed);
      }
    }
    else if (sides.size() == 2)
    {
      visitInnerEdge(first, sides.back(), counts);
    }
    else
    {
      ++counts.nonManifold;
    }
  }

  void visitInnerEdge(const EdgeSide& one, const EdgeSide& other, EdgeCounts& counts)
  {
    const bool consistent = one.isUpwards() != other.isUpwards();
    counts.inconsistent += !consistent;
    // The front of one triangle goes over into the front of the other, or into its back.
    const std::size_t turn = consistent ? 0 : 1;
    faces_.join(2 * one.triangle(), 2 * other.triangle() + turn);
    faces_.join(2 * one.triangle() + 1, 2 * other.triangle() + 1 - turn);

    const Eigen::Vector3d a = twiceAreaNormal(mesh_, one.triangle());
    const Eigen::Vector3d b = (consistent ? 1. : -1.) * twiceAreaNormal(mesh_, other.triangle());
    counts.folded += a.dot(b) < FoldedCosine * a.norm() * b.norm();
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
        regular += valence == (isOnBoundary_[v] != 0 ? 4 : 6);
      }
    }
    report_.unusedPoints = mesh_.points.size() - report_.vertices;
    report_.regularRatio = double(regular) / double(std::max<std::size_t>(1, report_.vertices));
    reportFans();
  }

  void reportFans()
  {
    std::vector<std::size_t> fansAt(mesh_.points.size(), 0);
    forEachTriangle(
      [&](std::size_t t)
      {
        const auto& triangle = mesh_.triangles[t];
        for (std::size_t k = 0; k < 3 && !usesPointTwice(triangle); ++k)
        {
          if (fans_.root(3 * t + k) == 3 * t + k)
          {
            increased(fansAt[triangle[k]]);
          }
        }
      });
    report_.nonManifoldVertices = std::size_t(
      std::count_if(fansAt.begin(), fansAt.end(), [](std::size_t fans) { return fans > 1; }));
  }

  void reportComponents()
  {
    const auto countOf = [&](const auto& isCounted)
    {
      return std::size_t(executor_.sum(mesh_.triangles.size(), ReportedPerRange,
        [&](std::size_t t) { return !usesPointTwice(mesh_.triangles[t]) && isCounted(t); }));
    };
    const std::size_t triangles = countOf([](std::size_t) { return true; });
    report_.components = countOf([&](std::size_t t) { return pieces_.root(t) == t; });
    const bool orientable =
      countOf([&](std::size_t t) { return faces_.areJoined(2 * t, 2 * t + 1); }) == 0;
    reportBoundary();
    const SurfaceReport& report = report_;
    if (triangles > 0 && report.isEdgeManifold() && report.isVertexManifold() && orientable)
    {
      const long characteristic = long(report.vertices) - long(edges_) + long(triangles);
      report_.genus = long(report.components) - (characteristic + long(report.boundaryLoops)) / 2;
    }
    if (report.isClosed() && report.isOriented())
    {
      report_.volume = volume_;
    }
  }

  /// Boundary edges follow each other where they end in the same fan.
  void reportBoundary()
  {
    report_.boundaryEdges = boundary_.size();
    if (boundary_.empty())
    {
      return;
    }
    ConcurrentSets loops(fans_);
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
  const Executor& executor_;
  ConcurrentSets fans_;   ///< corners that are connected by edges at their vertex
  ConcurrentSets pieces_; ///< triangles
  ConcurrentSets faces_;  ///< fronts (even) and backs (odd) of triangles
  std::vector<std::size_t> valences_;
  std::vector<std::uint8_t> isOnBoundary_;
  std::vector<EdgeSide> boundary_;
  std::size_t edges_ = 0;
  double volume_ = 0.;
  SurfaceReport report_;
};
}

SurfaceReport reportSurface(const TriangleMesh& mesh, const Executor& executor)
{
  return Reporter(mesh, executor).report();
}
}
