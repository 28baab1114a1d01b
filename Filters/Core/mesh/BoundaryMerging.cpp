// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoundaryMerging.h"

#include "mesh/TriangleShape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace neuralmesh
{
namespace
{
/// Where the mean counts, no vertex may be farther from the other loop than so many limits.
constexpr float FarthestVertex = 3.f;

using LoopIndex = BoundaryManager::LoopIndex;

struct LoopOfPoints
{
  LoopIndex index;
  std::vector<VertexIndex> vertices;
  Vector4 boxMin;
  Vector4 boxMax;
};

LoopOfPoints loopOfPoints(const Mesh& mesh, const BoundaryManager& boundaries, LoopIndex index)
{
  LoopOfPoints loop{ index, boundaries.vertices(mesh, index), {}, {} };
  loop.boxMin = loop.boxMax = mesh.position(loop.vertices.front());
  for (const VertexIndex v : loop.vertices)
  {
    loop.boxMin = min(loop.boxMin, mesh.position(v));
    loop.boxMax = max(loop.boxMax, mesh.position(v));
  }
  return loop;
}

float squaredDistance(const LoopOfPoints& a, const LoopOfPoints& b)
{
  return squaredNorm(max(max(a.boxMin - b.boxMax, b.boxMin - a.boxMax), Vector4()));
}

struct ClosestVertex
{
  std::size_t place = 0;
  float squaredDistance = std::numeric_limits<float>::infinity();
};

ClosestVertex closest(const Mesh& mesh, Vector4 position, const std::vector<VertexIndex>& loop)
{
  ClosestVertex result;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    const float squared = squaredNorm(mesh.position(loop[i]) - position);
    if (squared < result.squaredDistance)
    {
      result = { i, squared };
    }
  }
  return result;
}

/// What one loop is from another, as far as it is near.
struct OneWay
{
  double mean = 0.;
  double maximum = 0.;
};

std::optional<OneWay> distanceOneWay(
  const Mesh& mesh, const LoopOfPoints& from, const LoopOfPoints& to, double farthest)
{
  OneWay result;
  for (const VertexIndex v : from.vertices)
  {
    const double distance = std::sqrt(closest(mesh, mesh.position(v), to.vertices).squaredDistance);
    if (distance > farthest)
    {
      return std::nullopt;
    }
    result.mean += distance / double(from.vertices.size());
    result.maximum = std::max(result.maximum, distance);
  }
  return result;
}

/// The distance of two loops; nothing if it is not below the limit.
std::optional<double> distanceOf(const Mesh& mesh, const LoopOfPoints& a, const LoopOfPoints& b,
  double limit, LoopDistance distance)
{
  const double farthest = distance == LoopDistance::Mean ? FarthestVertex * limit : limit;
  if (squaredDistance(a, b) > farthest * farthest)
  {
    return std::nullopt;
  }
  const auto there = distanceOneWay(mesh, a, b, farthest);
  const auto back = there ? distanceOneWay(mesh, b, a, farthest) : std::nullopt;
  if (!back)
  {
    return std::nullopt;
  }
  const double result = distance == LoopDistance::Mean ? std::max(there->mean, back->mean)
                                                       : std::max(there->maximum, back->maximum);
  return result < limit ? std::optional(result) : std::nullopt;
}

/// How to walk along both loops at once: for each triangle, whether it is on an edge of the first.
using Strip = std::vector<bool>;

/// At each step the triangle that is closer to equilateral, as the thesis has it.
Strip equilateralStrip(std::span<const Vector4> first, std::span<const Vector4> second)
{
  Strip alongFirst;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.size() || j < second.size())
  {
    const Vector4 p = first[i % first.size()];
    const Vector4 q = second[j % second.size()];
    const bool along = j == second.size() ||
      (i < first.size() &&
        inequality(p, first[(i + 1) % first.size()], q) <=
          inequality(q, second[(j + 1) % second.size()], p));
    alongFirst.push_back(along);
    ++(along ? i : j);
  }
  return alongFirst;
}

/// The strip with the least sum of squared lengths of the edges across. A choice step by step may
/// run ahead on one loop; what is left of the other is then a fan of too many triangles.
Strip shortestStrip(std::span<const Vector4> first, std::span<const Vector4> second)
{
  const std::size_t width = second.size() + 1;
  Strip cameAlongFirst((first.size() + 1) * width);
  std::vector<float> cost(width); // of the strips to (i, j), for the present i
  for (std::size_t i = 0; i <= first.size(); ++i)
  {
    for (std::size_t j = 0; j <= second.size(); ++j)
    {
      const bool along = j == 0 || (i > 0 && cost[j] < cost[j - 1]);
      const float before = i + j == 0 ? 0.f : along ? cost[j] : cost[j - 1];
      cost[j] = before + squaredNorm(first[i % first.size()] - second[j % second.size()]);
      cameAlongFirst[i * width + j] = along;
    }
  }
  Strip alongFirst(first.size() + second.size());
  std::size_t i = first.size();
  std::size_t j = second.size();
  for (std::size_t step = alongFirst.size(); step-- > 0;)
  {
    alongFirst[step] = cameAlongFirst[i * width + j];
    --(alongFirst[step] ? i : j);
  }
  return alongFirst;
}

/// Makes the vertices of both loops that are closest to each other the first ones.
void beginAtClosest(
  const Mesh& mesh, std::vector<VertexIndex>& first, std::vector<VertexIndex>& second)
{
  std::size_t start = 0;
  ClosestVertex best;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    const ClosestVertex candidate = closest(mesh, mesh.position(first[i]), second);
    if (candidate.squaredDistance < best.squaredDistance)
    {
      start = i;
      best = candidate;
    }
  }
  std::rotate(first.begin(), first.begin() + std::ptrdiff_t(start), first.end());
  std::rotate(second.begin(), second.begin() + std::ptrdiff_t(best.place), second.end());
}

std::vector<Vector4> positionsOf(const Mesh& mesh, std::span<const VertexIndex> vertices)
{
  std::vector<Vector4> positions;
  positions.reserve(vertices.size());
  for (const VertexIndex v : vertices)
  {
    positions.push_back(mesh.position(v));
  }
  return positions;
}

/// Joins two loops; says whether that was legal.
bool join(Mesh& mesh, const LoopOfPoints& a, const LoopOfPoints& b, LoopDistance distance)
{
  std::vector<VertexIndex> first = a.vertices;
  std::vector<VertexIndex> second(b.vertices.rbegin(), b.vertices.rend());
  beginAtClosest(mesh, first, second);
  const auto makeStrip = distance == LoopDistance::Hausdorff ? equilateralStrip : shortestStrip;
  const Strip alongFirst = makeStrip(positionsOf(mesh, first), positionsOf(mesh, second));
  if (!mesh.canJoin(first, second, alongFirst))
  {
    return false;
  }
  mesh.join(first, second, alongFirst);
  return true;
}
}

std::size_t mergeBoundaries(Mesh& mesh, BoundaryManager& boundaries, double limit,
  LoopDistance distance,
  const std::function<bool(std::span<const VertexIndex>, std::span<const VertexIndex>)>& mayJoin)
{
  std::vector<LoopOfPoints> loops;
  for (LoopIndex index = 0; index < boundaries.loops().size(); ++index)
  {
    if (boundaries.loops()[index].size > 0)
    {
      loops.push_back(loopOfPoints(mesh, boundaries, index));
    }
  }
  struct Pair
  {
    double distance;
    std::size_t a, b;
    auto operator<=>(const Pair&) const = default;
  };
  std::vector<Pair> pairs;
  for (std::size_t a = 0; a < loops.size(); ++a)
  {
    for (std::size_t b = a + 1; b < loops.size(); ++b)
    {
      const auto near = distanceOf(mesh, loops[a], loops[b], limit, distance);
      if (near && (!mayJoin || mayJoin(loops[a].vertices, loops[b].vertices)))
      {
        pairs.push_back({ *near, a, b });
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::size_t merged = 0;
  for (const Pair& pair : pairs)
  {
    std::vector<VertexIndex>& a = loops[pair.a].vertices;
    std::vector<VertexIndex>& b = loops[pair.b].vertices;
    if (!a.empty() && !b.empty() && join(mesh, loops[pair.a], loops[pair.b], distance))
    {
      a.insert(a.end(), b.begin(), b.end());
      boundaries.retrace(mesh, a);
      a.clear();
      b.clear();
      ++merged;
    }
  }
  return merged;
}
}
