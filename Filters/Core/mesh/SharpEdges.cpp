// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SharpEdges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

namespace neuralmesh
{
namespace
{
/// An edge as one triangle sees it, by the first points at the places of its ends and of the corner over it.
struct TurnSide
{
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t apex;

  bool operator==(const TurnSide&) const = default;
};

bool comesBefore(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

/// For each point the first one at its place.
std::vector<std::uint32_t> firstAtPlace(const std::vector<Eigen::Vector3d>& points)
{
  // The first coordinate goes along with the index: most are told apart by it.
  std::vector<std::pair<double, std::uint32_t>> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i)
  {
    order[i] = { points[i].x(), i };
  }
  std::sort(order.begin(), order.end(),
    [&](const auto& a, const auto& b)
    {
      if (a.first != b.first)
      {
        return a.first < b.first;
      }
      const Eigen::Vector3d &pointA = points[a.second], &pointB = points[b.second];
      return pointA == pointB ? a.second < b.second : comesBefore(pointA, pointB);
    });
  std::vector<std::uint32_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const std::uint32_t point = order[i].second;
    const bool isLikeLast = i > 0 && points[order[i - 1].second] == points[point];
    first[point] = isLikeLast ? first[order[i - 1].second] : point;
  }
  return first;
}

/// The sides of all triangles, those of an edge one behind the other: in buckets by the lower end, then
/// sorted. A triangle that is there twice has them once.
std::vector<TurnSide> sidesByEdge(const TriangleMesh& mesh)
{
  const std::vector<std::uint32_t> place = firstAtPlace(mesh.points);
  const auto forEachSide = [&](const auto& use)
  {
    for (const auto& [a, b, c] : mesh.triangles)
    {
      for (const auto& [from, to, over] : { std::array{ a, b, c }, { b, c, a }, { c, a, b } })
      {
        const auto [low, high] = std::minmax(place[from], place[to]);
        use(TurnSide{ low, high, place[over] });
      }
    }
  };
  std::vector<std::size_t> ends(mesh.points.size() + 1, 0);
  forEachSide([&](const TurnSide& side) { ++ends[side.low + 1]; });
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<TurnSide> sides(ends.back());
  forEachSide([&](const TurnSide& side) { sides[ends[side.low]++] = side; });
  auto begin = sides.begin();
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    const auto end = sides.begin() + std::ptrdiff_t(ends[point]);
    std::sort(begin, end,
      [](const TurnSide& a, const TurnSide& b)
      { return a.high != b.high ? a.high < b.high : a.apex < b.apex; });
    begin = end;
  }
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  return sides;
}

/// From an edge into the triangle, along its height.
Eigen::Vector3d heightOver(const std::vector<Eigen::Vector3d>& points, const TurnSide& side)
{
  const Eigen::Vector3d along = (points[side.high] - points[side.low]).normalized();
  const Eigen::Vector3d toApex = points[side.apex] - points[side.low];
  return toApex - toApex.dot(along) * along;
}
}

std::vector<EdgeEnds> sharpEdges(const TriangleMesh& mesh, double leastTurn, double leastHeight)
{
  const std::vector<TurnSide> sides = sidesByEdge(mesh);
  const double leastCosine = std::cos(leastTurn);
  std::vector<EdgeEnds> edges;
  std::vector<Eigen::Vector3d> directions;
  const auto isSharp = [&](std::span<const TurnSide> around)
  {
    directions.clear();
    for (const TurnSide& side : around)
    {
      const Eigen::Vector3d height = heightOver(mesh.points, side);
      const double length = height.norm();
      if (!(length >= leastHeight))
      {
        return false;
      }
      directions.emplace_back(height / length);
    }
    const auto goesOn = [&](const Eigen::Vector3d& from)
    {
      return std::any_of(directions.begin(), directions.end(),
        [&](const Eigen::Vector3d& to) { return from.dot(to) <= -leastCosine; });
    };
    return !std::all_of(directions.begin(), directions.end(), goesOn);
  };
  for (auto first = sides.begin(); first != sides.end();)
  {
    const auto last = std::find_if(first, sides.end(),
      [&](const TurnSide& side) { return side.low != first->low || side.high != first->high; });
    if (last - first > 1 && isSharp({ first, last }))
    {
      edges.push_back({ mesh.points[first->low], mesh.points[first->high] });
    }
    first = last;
  }
  return edges;
}
}
