// SPDX-License-Identifier: BSD-3-Clause
#include "run/FeatureLines.h"

#include "base/DisjointSets.h"
#include "cloud/CloudPlaces.h"
#include "run/CreaseEdges.h"
#include "run/CreaseGraph.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace neuralmesh
{
namespace
{
/// A line that turns by more within two edges on either side has a corner there, in degrees.
constexpr double SharpTurn = 50.;
constexpr std::size_t EdgesOfTurn = 2;
/// How much a point of a line stays at its vertex, beside each plane that draws it away.
constexpr double PullOfVertex = 0.01;
/// Of the progress: then the points have their places on the mesh, and triangles their planes.
constexpr double EndOfPlaces = 0.4;
constexpr double EndOfPlanes = 0.5;

/// Makes lines of what is left of a graph.
class LineBuilder
{
public:
  LineBuilder(const CreaseGraph& graph, const Mesh& mesh, const PointCloud& cloud)
    : graph_(graph)
    , mesh_(mesh)
    , cloud_(cloud)
    , isCorner_(mesh.indexEnd())
    , positions_(mesh.indexEnd())
  {
  }

  FeatureLines run() &&
  {
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (graph_.degree(v) > 0)
      {
        positions_[v] = placeOf(v);
        isCorner_[v] = graph_.degree(v) != 2;
      }
    }
    for (const CreaseGraph::Path& path : graph_.paths())
    {
      findTurns(path);
    }
    addPoints();
    for (const CreaseGraph::Path& path : graph_.paths(isCorner_))
    {
      addLine(path);
    }
    nameChains();
    return std::move(result_);
  }

private:
  /// Where the planes of both sides of the edges at a vertex meet.
  Eigen::Vector3d placeOf(VertexIndex v) const
  {
    const Eigen::Vector3d position = mesh_.position(v).toDouble();
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    double planes = 0., longest = 0.;
    for (const std::uint32_t e : graph_.edgesAt(v))
    {
      longest =
        std::max(longest, (mesh_.position(graph_.otherEnd(e, v)).toDouble() - position).norm());
      if (!graph_.edge(e).isConfirmed)
      {
        continue;
      }
      for (const FacePlanes::Plane& plane : graph_.edge(e).sides)
      {
        matrix += plane.normal * plane.normal.transpose();
        right -= plane.distance(position) * plane.normal;
        ++planes;
      }
    }
    matrix.diagonal().array() += PullOfVertex * std::max(planes, 1.);
    const Eigen::Vector3d move = matrix.ldlt().solve(right);
    return position + (move.norm() <= longest ? 1. : 0.) * move;
  }

  /// Marks the vertices at which a path turns more sharply than SharpTurn, and than at those beside them.
  void findTurns(const CreaseGraph::Path& path)
  {
    const auto& vertices = path.vertices;
    const auto count = std::ptrdiff_t(path.edges.size());
    const auto step = std::ptrdiff_t(EdgesOfTurn);
    const bool isLoop = path.isLoop();
    const auto at = [&](std::ptrdiff_t i)
    {
      const std::ptrdiff_t place =
        isLoop ? (i + count) % count : std::clamp<std::ptrdiff_t>(i, 0, count);
      return positions_[vertices[std::size_t(place)]];
    };
    if (count <= 2 * step)
    {
      return;
    }
    std::vector<double> turns(std::size_t(count), 0.);
    for (std::ptrdiff_t i = isLoop ? 0 : 1; i < count; ++i)
    {
      const Eigen::Vector3d before = at(i) - at(i - step);
      const Eigen::Vector3d after = at(i + step) - at(i);
      turns[std::size_t(i)] = std::atan2(before.cross(after).norm(), before.dot(after));
    }
    const auto turnAt = [&](std::ptrdiff_t i)
    {
      const bool isInside = isLoop || (i > 0 && i < count);
      return isInside ? turns[std::size_t((i + count) % count)] : 0.;
    };
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      bool isSharpest = turnAt(i) > SharpTurn * std::numbers::pi / 180.;
      for (std::ptrdiff_t other = 1; other <= step; ++other)
      {
        isSharpest = isSharpest && turnAt(i) > turnAt(i - other) && turnAt(i) >= turnAt(i + other);
      }
      if (isSharpest)
      {
        isCorner_[vertices[std::size_t(i)]] = true;
      }
    }
  }

  void addPoints()
  {
    result_.creases.assign(mesh_.indexEnd(), 0.);
    pointOf_.resize(mesh_.indexEnd());
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (graph_.degree(v) == 0)
      {
        continue;
      }
      for (const std::uint32_t e : graph_.edgesAt(v))
      {
        result_.creases[v] = std::max(result_.creases[v], graph_.edge(e).angle);
      }
      pointOf_[v] = std::uint32_t(result_.points.size());
      if (isCorner_[v])
      {
        result_.corners.push_back({ pointOf_[v], result_.creases[v] });
      }
      result_.points.push_back(cloud_.toInput(Vector4(positions_[v])));
      result_.vertices.push_back(v);
    }
  }

  void addLine(const CreaseGraph::Path& path)
  {
    FeatureLine line;
    for (const VertexIndex v : path.vertices)
    {
      line.points.push_back(pointOf_[v]);
    }
    for (std::size_t i = 0; i < path.edges.size(); ++i)
    {
      const double length =
        (result_.points[line.points[i + 1]] - result_.points[line.points[i]]).norm();
      line.length += length;
      line.angle += graph_.edge(path.edges[i]).angle;
    }
    line.angle /= double(path.edges.size());
    result_.lines.push_back(std::move(line));
  }

  /// Numbers what hangs together, the longest first.
  void nameChains()
  {
    DisjointSets sets(result_.points.size());
    for (const FeatureLine& line : result_.lines)
    {
      for (const std::uint32_t point : line.points)
      {
        sets.join(point, line.points.front());
      }
    }
    std::vector<double> lengths(result_.points.size(), 0.);
    for (const FeatureLine& line : result_.lines)
    {
      lengths[sets.root(line.points.front())] += line.length;
    }
    std::vector<std::size_t> chains;
    for (std::size_t point = 0; point < result_.points.size(); ++point)
    {
      if (sets.root(point) == point)
      {
        chains.push_back(point);
      }
    }
    std::stable_sort(chains.begin(), chains.end(),
      [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
    std::vector<std::size_t> number(result_.points.size());
    for (std::size_t i = 0; i < chains.size(); ++i)
    {
      number[chains[i]] = i;
    }
    for (FeatureLine& line : result_.lines)
    {
      line.chain = number[sets.root(line.points.front())];
    }
    for (FeatureLines::Corner& corner : result_.corners)
    {
      corner.chain = number[sets.root(corner.point)];
    }
  }

  const CreaseGraph& graph_;
  const Mesh& mesh_;
  const PointCloud& cloud_;
  std::vector<bool> isCorner_;
  std::vector<Eigen::Vector3d> positions_;
  std::vector<std::uint32_t> pointOf_;
  FeatureLines result_;
};
}

std::optional<FeatureLines> findFeatureLines(const Mesh& mesh, const PointCloud& cloud,
  double leastAngle, const Progress& progress, const Executor& executor)
{
  bool goesOn = true;
  const auto report = [&](double fraction) { return goesOn = goesOn && progress(fraction); };
  const CloudPlaces places(
    cloud, mesh, [&](double fraction) { return report(EndOfPlaces * fraction); }, executor);
  if (!report(EndOfPlaces))
  {
    return {};
  }
  const FacePlanes planes(places, executor);
  std::vector<CreaseEdge> edges = findCreaseEdges(
    planes, places, leastAngle,
    [&](double fraction) { return report(EndOfPlanes + (1. - EndOfPlanes) * fraction); }, executor);
  if (!report(1.))
  {
    return {};
  }
  CreaseGraph graph(std::move(edges), mesh, planes.rings());
  graph.prune();
  return LineBuilder(graph, mesh, cloud).run();
}
}
