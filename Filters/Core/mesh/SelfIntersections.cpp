// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SelfIntersections.h"

#include "base/Morton.h"
#include "base/TouchedVector.h"
#include "mesh/BoxTree.h"
#include "mesh/TriangleIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace neuralmesh
{
namespace
{
const double FoldCosine = std::cos(150. * std::numbers::pi / 180.);
/// So much of a right angle is left that rounding does not matter.
constexpr float LeastSquaredCosine = 0.04f;
/// Parts for the executor.
constexpr std::size_t CandidatesPerRange = 4096;
constexpr std::size_t FoldsPerRange = 4096;

/// Brings the corners that `other` has, too, to the front; returns how many there are.
unsigned sharedToFront(Triangle& triangle, const Triangle& other)
{
  unsigned shared = 0;
  for (VertexIndex& v : triangle)
  {
    if (v == other[0] || v == other[1] || v == other[2])
    {
      std::swap(triangle[shared++], v);
    }
  }
  return shared;
}

Corners cornersOf(const Mesh& mesh, const Triangle& triangle)
{
  return { mesh.position(triangle[0]).toDouble(), mesh.position(triangle[1]).toDouble(),
    mesh.position(triangle[2]).toDouble() };
}

/// Whether the triangles around a vertex lie side by side as seen along its normal, each turned by clearly less than a
/// right angle from it: then no two of them intersect.
bool isStarSimple(const Mesh& mesh, VertexIndex v)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 normal = mesh.normal(v), center = mesh.position(v);
  const float squaredNormal = squaredNorm(normal);
  if (ring.isOpen() || !(squaredNormal > 0.f))
  {
    return false;
  }
  const Vector4 first = mesh.position(ring.front()) - center;
  const Vector4 across = cross(normal, first);
  Vector4 from = mesh.position(ring.back()) - center;
  unsigned turns = 0;
  for (const VertexIndex neighbor : ring)
  {
    const Vector4 to = mesh.position(neighbor) - center;
    const Vector4 area = cross(from, to);
    const float along = dot(area, normal);
    if (!(along > 0.f) || !(along * along > LeastSquaredCosine * squaredNorm(area) * squaredNormal))
    {
      return false;
    }
    turns += dot(across, from) < 0.f && dot(across, to) >= 0.f ? 1 : 0;
    from = to;
  }
  return turns == 1;
}

/// Whether stars are simple, asked for when it is needed, by several threads maybe.
class SimpleStars
{
public:
  SimpleStars(const Mesh& mesh)
    : mesh_(mesh)
    , known_(mesh.indexEnd(), Unknown)
  {
  }

  bool operator[](VertexIndex v)
  {
    const std::atomic_ref<std::uint8_t> known(known_[v]);
    std::uint8_t isSimple = known.load(std::memory_order_relaxed);
    if (isSimple == Unknown)
    {
      isSimple = isStarSimple(mesh_, v) ? 1 : 0;
      known.store(isSimple, std::memory_order_relaxed);
    }
    return isSimple == 1;
  }

private:
  static constexpr std::uint8_t Unknown = 2;

  const Mesh& mesh_;
  std::vector<std::uint8_t> known_;
};

bool doIntersect(const Mesh& mesh, SimpleStars& isSimple, Triangle first, Triangle second)
{
  // Of two that almost lie on each other, it may depend on which one comes first: that is never by chance.
  if (second < first)
  {
    std::swap(first, second);
  }
  const unsigned shared = sharedToFront(first, second);
  if ((shared == 1 || shared == 2) && (isSimple[first[0]] || (shared == 2 && isSimple[first[1]])))
  {
    return false;
  }
  sharedToFront(second, first);
  if (shared == 2 && first[0] != second[0])
  {
    std::swap(second[0], second[1]);
  }
  const Corners a = cornersOf(mesh, first), b = cornersOf(mesh, second);
  switch (shared)
  {
    case 0:
      return intersect(a, b);
    case 1:
      return intersectBesidesFirstCorner(a, b);
    case 2:
      return lieOnEachOther(a, b);
    default:
      return true;
  }
}

/// Along a Morton curve.
std::vector<VertexIndex> verticesAlongCurve(
  const Mesh& mesh, const std::vector<VertexIndex>& vertices, const Executor& executor)
{
  auto positions = touchedVector<LargeVector<Vector4>>(vertices.size(), executor);
  std::vector<Box> bounds((vertices.size() + CandidatesPerRange - 1) / CandidatesPerRange);
  executor.forEachRange(vertices.size(), CandidatesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        positions[i] = mesh.position(vertices[i]);
        bounds[begin / CandidatesPerRange].extend(positions[i]);
      }
    });
  Box all;
  for (const Box& box : bounds)
  {
    all.extend(box);
  }
  std::vector<VertexIndex> order = mortonOrder(positions, all.low, all.high, executor);
  executor.forEachRange(order.size(), CandidatesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        order[i] = vertices[order[i]];
      }
    });
  return order;
}

/// What `find(i, found)` finds for the numbers below `count`, in their order.
template <typename Found, typename Find>
void addFound(
  std::size_t count, const Executor& executor, std::vector<Found>& all, const Find& find)
{
  std::vector<std::vector<Found>> ranges((count + CandidatesPerRange - 1) / CandidatesPerRange);
  executor.forEachRange(count, CandidatesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        find(i, ranges[begin / CandidatesPerRange]);
      }
    });
  // Where those of each range go.
  std::vector<std::size_t> places(ranges.size() + 1, all.size());
  for (std::size_t range = 0; range < ranges.size(); ++range)
  {
    places[range + 1] = places[range] + ranges[range].size();
  }
  all.resize(places.back());
  executor.forEachPart(ranges.size(),
    [&](std::size_t range)
    {
      std::copy(
        ranges[range].begin(), ranges[range].end(), all.begin() + std::ptrdiff_t(places[range]));
      std::vector<Found>().swap(ranges[range]);
    });
}

/// The triangles of which a corner v has `isAsked[v]`, neighbours where they follow each other.
std::vector<Triangle> askedTriangles(
  const Mesh& mesh, const std::vector<bool>& isAsked, const Executor& executor)
{
  // Each triangle belongs to its corner of the lowest index. Where few are asked for, this looks at no others.
  std::vector<std::uint8_t> hasAsked(mesh.indexEnd());
  executor.forEachRange(mesh.indexEnd(), CandidatesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        if (isAsked[v])
        {
          const Ring& ring = mesh.ring(v);
          for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
          {
            const VertexIndex lowest = std::min({ v, ring[slot], ring[ring.after(slot)] });
            std::atomic_ref<std::uint8_t>(hasAsked[lowest]).store(1, std::memory_order_relaxed);
          }
        }
      }
    });
  std::vector<VertexIndex> vertices;
  addFound(mesh.indexEnd(), executor, vertices,
    [&](std::size_t i, std::vector<VertexIndex>& found)
    {
      if (hasAsked[i] != 0)
      {
        found.push_back(VertexIndex(i));
      }
    });
  vertices = verticesAlongCurve(mesh, vertices, executor);
  std::vector<Triangle> triangles;
  triangles.reserve(2 * mesh.vertexCount());
  touchReserved(triangles, executor);
  addFound(vertices.size(), executor, triangles,
    [&](std::size_t i, std::vector<Triangle>& found)
    {
      mesh.forEachTriangleFrom(vertices[i],
        [&](VertexIndex a, VertexIndex b, VertexIndex c)
        {
          if (isAsked[a] || isAsked[b] || isAsked[c])
          {
            found.push_back({ a, b, c });
          }
        });
    });
  return triangles;
}

/// Triangles of a mesh: first those that are asked for, then others that may overlap them.
class Candidates
{
public:
  Candidates(const Mesh& mesh, const std::vector<bool>& isAsked, const Executor& executor)
    : triangles_(askedTriangles(mesh, isAsked, executor))
    , tree_(std::uint32_t(triangles_.size()), { mesh, triangles_ }, executor)
  {
    addFound(triangles_.empty() ? 0 : mesh.indexEnd(), executor, triangles_,
      [&](std::size_t i, std::vector<Triangle>& found)
      {
        const auto v = VertexIndex(i);
        if (isAsked[v] || !mesh.isAlive(v) || !tree_.isNear(boxAround(mesh, v)))
        {
          return;
        }
        mesh.forEachTriangleFrom(v,
          [&](VertexIndex a, VertexIndex b, VertexIndex c)
          {
            if (!isAsked[a] && !isAsked[b] && !isAsked[c])
            {
              found.push_back({ a, b, c });
            }
          });
      });
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// Calls `use(i, j)` for the indices of every two triangles whose boxes overlap, of which one is asked for; threads
  /// of the executor do so at the same time.
  template <typename Use>
  void forEachPair(const Use& use) const
  {
    tree_.forEachOverlap(std::uint32_t(triangles_.size()), use);
  }

private:
  struct BoxOfTriangle
  {
    const Mesh& mesh;
    const std::vector<Triangle>& triangles;

    Box operator()(std::uint32_t i) const
    {
      Box box;
      for (const VertexIndex v : triangles[i])
      {
        box.extend(mesh.position(v));
      }
      return box;
    }
  };

  static Box boxAround(const Mesh& mesh, VertexIndex v)
  {
    Box box;
    box.extend(mesh.position(v));
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      box.extend(mesh.position(neighbor));
    }
    return box;
  }

  std::vector<Triangle> triangles_;
  BoxTree<BoxOfTriangle> tree_;
};
}

std::vector<Triangle> intersectingTriangles(const Mesh& mesh, const Executor& executor)
{
  return intersectingTriangles(mesh, std::vector<bool>(mesh.indexEnd(), true), executor);
}

std::vector<Triangle> intersectingTriangles(
  const Mesh& mesh, const std::vector<bool>& isAsked, const Executor& executor)
{
  const Candidates candidates(mesh, isAsked, executor);
  const std::vector<Triangle>& all = candidates.triangles();
  std::vector<std::uint8_t> isFound(all.size());
  SimpleStars isSimple(mesh);
  const auto found = [&](std::uint32_t i) { return std::atomic_ref<std::uint8_t>(isFound[i]); };
  candidates.forEachPair(
    [&](std::uint32_t i, std::uint32_t j)
    {
      // Nothing is to be learnt of two that are found.
      constexpr auto Order = std::memory_order_relaxed;
      if (!(found(i).load(Order) != 0 && found(j).load(Order) != 0) &&
        doIntersect(mesh, isSimple, all[i], all[j]))
      {
        found(i).store(1, Order);
        found(j).store(1, Order);
      }
    });
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (isFound[i] != 0)
    {
      triangles.push_back(all[i]);
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<TrianglePair> intersectingPairs(const Mesh& mesh)
{
  return intersectingPairs(mesh, std::vector<bool>(mesh.indexEnd(), true));
}

std::vector<TrianglePair> intersectingPairs(const Mesh& mesh, const std::vector<bool>& isAsked)
{
  const Candidates candidates(mesh, isAsked, Executor::sequential());
  const std::vector<Triangle>& all = candidates.triangles();
  std::vector<TrianglePair> pairs;
  SimpleStars isSimple(mesh);
  candidates.forEachPair(
    [&](std::uint32_t i, std::uint32_t j)
    {
      if (doIntersect(mesh, isSimple, all[i], all[j]))
      {
        pairs.push_back({ std::min(all[i], all[j]), std::max(all[i], all[j]) });
      }
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::array<VertexIndex, 2> oppositeTo(const Mesh& mesh, const Edge& edge)
{
  const Ring& ring = mesh.ring(edge[0]);
  const unsigned slot = ring.find(edge[1]);
  return { ring.next(slot), ring.previous(slot) };
}

bool isFolded(const Mesh& mesh, const Edge& edge)
{
  const auto [next, previous] = oppositeTo(mesh, edge);
  if (next == NoVertex || previous == NoVertex)
  {
    return false;
  }
  const Eigen::Vector3d a = mesh.position(edge[0]).toDouble();
  const Eigen::Vector3d along = mesh.position(edge[1]).toDouble() - a;
  const Eigen::Vector3d left = along.cross(mesh.position(next).toDouble() - a);
  const Eigen::Vector3d right = (mesh.position(previous).toDouble() - a).cross(along);
  return left.dot(right) < FoldCosine * left.norm() * right.norm();
}

std::vector<Edge> foldedEdges(const Mesh& mesh, const Executor& executor)
{
  return foldedEdges(mesh, std::vector<bool>(mesh.indexEnd(), true), executor);
}

std::vector<Edge> foldedEdges(
  const Mesh& mesh, const std::vector<bool>& isAsked, const Executor& executor)
{
  const auto isAskedVertex = [&](VertexIndex v) { return v != NoVertex && isAsked[v]; };
  std::vector<std::vector<Edge>> edgesOf((mesh.indexEnd() + FoldsPerRange - 1) / FoldsPerRange);
  const auto lookAt = [&](VertexIndex v, std::vector<Edge>& edges)
  {
    const Ring& ring = mesh.ring(v);
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const VertexIndex neighbor = ring[slot];
      if (v < neighbor &&
        (isAsked[v] || isAsked[neighbor] || isAskedVertex(ring.next(slot)) ||
          isAskedVertex(ring.previous(slot))) &&
        isFolded(mesh, { v, neighbor }))
      {
        edges.push_back({ v, neighbor });
      }
    }
  };
  executor.forEachRange(mesh.indexEnd(), FoldsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        lookAt(v, edgesOf[begin / FoldsPerRange]);
      }
    });
  std::vector<Edge> edges;
  for (const std::vector<Edge>& some : edgesOf)
  {
    edges.insert(edges.end(), some.begin(), some.end());
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::vector<VertexIndex> brokenVertices(
  const Mesh& mesh, const std::vector<bool>& isAsked, const Executor& executor)
{
  std::vector<VertexIndex> broken;
  for (const Triangle& triangle : intersectingTriangles(mesh, isAsked, executor))
  {
    broken.insert(broken.end(), triangle.begin(), triangle.end());
  }
  for (const Edge& edge : foldedEdges(mesh, isAsked, executor))
  {
    const Edge opposite = oppositeTo(mesh, edge);
    broken.insert(broken.end(), edge.begin(), edge.end());
    broken.insert(broken.end(), opposite.begin(), opposite.end());
  }
  return broken;
}
}
