// SPDX-License-Identifier: BSD-3-Clause
#include "ManifoldCheck.h"

#include <algorithm>
#include <compare>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Index = std::uint32_t;

class UnionFind
{
public:
  explicit UnionFind(std::size_t count)
    : parent_(count)
  {
    std::iota(this->parent_.begin(), this->parent_.end(), std::size_t(0));
  }
  std::size_t root(std::size_t i)
  {
    while (this->parent_[i] != i)
    {
      i = this->parent_[i] = this->parent_[this->parent_[i]];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b) { this->parent_[this->root(a)] = this->root(b); }

private:
  std::vector<std::size_t> parent_;
};

/// An edge in the direction in which a triangle runs along it.
struct HalfEdge
{
  std::pair<Index, Index> ends;
  std::size_t triangle;

  auto operator<=>(const HalfEdge&) const = default;
};

std::string edgeText(Index a, Index b) { return std::to_string(a) + "-" + std::to_string(b); }
}

ManifoldReport checkManifold(
  std::size_t pointCount, std::span<const std::array<std::uint32_t, 3>> triangles)
{
  ManifoldReport report;
  std::vector<HalfEdge> halfEdges;
  halfEdges.reserve(3 * triangles.size());
  std::vector<std::size_t> cornersAt(pointCount, 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Index a = triangles[t][k];
      const Index b = triangles[t][(k + 1) % 3];
      if (a >= pointCount)
      {
        report.defect = "index " + std::to_string(a) + " is out of range";
        return report;
      }
      if (a == b)
      {
        report.defect = "triangle " + std::to_string(t) + " has a point twice";
        return report;
      }
      ++cornersAt[a];
      halfEdges.push_back({ { a, b }, t });
    }
  }
  std::sort(halfEdges.begin(), halfEdges.end());
  const auto twice = std::adjacent_find(halfEdges.begin(), halfEdges.end(),
    [](const HalfEdge& left, const HalfEdge& right) { return left.ends == right.ends; });
  if (twice != halfEdges.end())
  {
    const auto [a, b] = twice->ends;
    report.defect = "edge " + edgeText(a, b) + " is run along twice in one direction";
    return report;
  }

  // Corners that share an edge belong to the same fan; so do, by their triangles, components.
  UnionFind components(triangles.size());
  UnionFind corners(3 * triangles.size());
  const auto cornerAt = [&](std::size_t t, Index v)
  {
    const auto& triangle = triangles[t];
    return 3 * t + (triangle[0] == v ? 0u : triangle[1] == v ? 1u : 2u);
  };
  std::map<Index, Index> nextOnBoundary;
  std::size_t fullEdges = 0;
  for (const auto& [ends, t] : halfEdges)
  {
    const auto [a, b] = ends;
    const HalfEdge wanted{ { b, a }, 0 };
    const auto opposite = std::lower_bound(halfEdges.begin(), halfEdges.end(), wanted);
    if (opposite == halfEdges.end() || opposite->ends != wanted.ends)
    {
      ++report.boundaryEdges;
      if (!nextOnBoundary.try_emplace(b, a).second)
      {
        report.defect = "vertex " + std::to_string(b) + " lies on the boundary twice";
        return report;
      }
      continue;
    }
    ++fullEdges;
    components.join(t, opposite->triangle);
    corners.join(cornerAt(t, a), cornerAt(opposite->triangle, a));
    corners.join(cornerAt(t, b), cornerAt(opposite->triangle, b));
  }
  std::vector<std::size_t> fansAt(pointCount, 0);
  for (std::size_t corner = 0; corner < 3 * triangles.size(); ++corner)
  {
    if (corners.root(corner) == corner)
    {
      const Index v = triangles[corner / 3][corner % 3];
      if (++fansAt[v] > 1)
      {
        report.defect = "the triangles at vertex " + std::to_string(v) + " are not one fan";
        return report;
      }
    }
  }

  for (const std::size_t count : cornersAt)
  {
    ++(count > 0 ? report.usedPoints : report.unusedPoints);
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    report.components += components.root(t) == t;
  }
  while (!nextOnBoundary.empty())
  {
    ++report.boundaryLoops;
    for (auto at = nextOnBoundary.begin(); at != nextOnBoundary.end();)
    {
      const Index next = at->second;
      nextOnBoundary.erase(at);
      at = nextOnBoundary.find(next);
    }
  }
  report.eulerCharacteristic =
    long(report.usedPoints) - long(fullEdges / 2 + report.boundaryEdges) + long(triangles.size());
  return report;
}
}
