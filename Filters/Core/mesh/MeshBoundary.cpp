// SPDX-License-Identifier: BSD-3-Clause
// The operations of a mesh that make and close boundaries.
#include "mesh/Mesh.h"

#include <algorithm>
#include <bitset>
#include <cassert>
#include <map>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Whether these are the vertices of a boundary loop, each once: in its direction, or against it.
bool isLoop(const Mesh& mesh, std::span<const VertexIndex> vertices, bool against)
{
  const auto follows = [&](std::size_t i)
  {
    const Ring& ring = mesh.ring(vertices[i]);
    const VertexIndex next = vertices[(i + 1) % vertices.size()];
    return ring.isOpen() && (against ? ring.front() : ring.back()) == next;
  };
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    if (!follows(i) || (i > 0 && vertices[i] == vertices[0]))
    {
      return false;
    }
  }
  return !vertices.empty();
}

/// From the first boundary to the second one.
using Rung = std::pair<VertexIndex, VertexIndex>;

/// The edges across a strip, as it is walked once around; the first edge is the last.
std::vector<Rung> stripEdges(std::span<const VertexIndex> first,
  std::span<const VertexIndex> second, const std::vector<bool>& alongFirst)
{
  std::vector<Rung> edges;
  edges.reserve(alongFirst.size());
  std::size_t i = 0;
  std::size_t j = 0;
  for (const bool along : alongFirst)
  {
    ++(along ? i : j);
    edges.emplace_back(first[i % first.size()], second[j % second.size()]);
  }
  return edges;
}

/// Triangles at a vertex, by the slots of their first neighbours.
using Slots = std::bitset<Ring::Capacity>;

/// Triangles at a vertex, each beside the next.
struct BoundaryFan
{
  unsigned first = 0; ///< slot
  unsigned triangleCount = 0;

  bool contains(const Ring& ring, unsigned slot) const
  {
    return ring.before(slot, first) < triangleCount;
  }
};

/// The largest fan that is left at a vertex without the triangles in `removed`, which are some; of
/// equally large ones the first.
BoundaryFan largestFan(const Ring& ring, const Slots& removed)
{
  unsigned begin = 0;
  while (!ring.isOpen() && !removed[begin])
  {
    ++begin;
  }
  BoundaryFan largest, fan;
  for (unsigned i = 0; i < ring.triangleCount(); ++i)
  {
    const unsigned slot = ring.after(begin, i);
    fan = removed[slot] ? BoundaryFan{ ring.after(slot), 0 }
                        : BoundaryFan{ fan.first, fan.triangleCount + 1 };
    largest = fan.triangleCount > largest.triangleCount ? fan : largest;
  }
  return largest;
}
}

Mesh::Removal Mesh::removeTriangles(std::span<const Triangle> triangles)
{
  // First what goes, until no vertex is left with two fans; then all at once.
  std::map<VertexIndex, Slots> removed;
  std::vector<VertexIndex> changed;
  const auto remove = [&](const Triangle& triangle)
  {
    for (unsigned corner = 0; corner < 3; ++corner)
    {
      const VertexIndex v = triangle[corner];
      removed[v].set(rings_[v].find(triangle[(corner + 1) % 3]));
      changed.push_back(v);
    }
  };
  for (const Triangle& triangle : triangles)
  {
    if (contains(triangle))
    {
      remove(triangle);
    }
  }
  while (!changed.empty())
  {
    const VertexIndex v = changed.back();
    changed.pop_back();
    const Ring& ring = rings_[v];
    const BoundaryFan fan = largestFan(ring, removed[v]);
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      if (!removed[v][slot] && !fan.contains(ring, slot))
      {
        remove({ v, ring[slot], ring[ring.after(slot)] });
      }
    }
  }

  Removal result;
  for (const auto& [v, slots] : removed)
  {
    result.vertices.push_back(v);
    result.triangleCount += slots.count();
    const Ring ring = rings_[v];
    const BoundaryFan fan = largestFan(ring, slots);
    if (fan.triangleCount == 0)
    {
      eraseVertex(v);
      continue;
    }
    std::array<VertexIndex, Ring::Capacity> neighbors{};
    for (unsigned i = 0; i <= fan.triangleCount; ++i)
    {
      neighbors[i] = ring[ring.after(fan.first, i)];
    }
    rings_[v].assign(std::span(neighbors).first(fan.triangleCount + 1), true);
  }
  result.triangleCount /= 3;
  return result;
}

bool Mesh::canJoin(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
  const std::vector<bool>& alongFirst) const
{
  const auto stepsAlongFirst = std::count(alongFirst.begin(), alongFirst.end(), true);
  if (!isLoop(*this, first, false) || !isLoop(*this, second, true) ||
    std::find(second.begin(), second.end(), first[0]) != second.end() ||
    std::size_t(stepsAlongFirst) != first.size() ||
    alongFirst.size() != first.size() + second.size())
  {
    return false;
  }
  std::vector<Rung> edges = stripEdges(first, second, alongFirst);
  const auto fits = [&](VertexIndex v, auto end)
  {
    const auto added =
      std::count_if(edges.begin(), edges.end(), [&](const auto& edge) { return edge.*end == v; });
    return valence(v) + unsigned(added) <= Ring::Capacity;
  };
  const bool allFit =
    std::all_of(first.begin(), first.end(), [&](VertexIndex v) { return fits(v, &Rung::first); }) &&
    std::all_of(
      second.begin(), second.end(), [&](VertexIndex v) { return fits(v, &Rung::second); });
  std::sort(edges.begin(), edges.end());
  return allFit && std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
    std::none_of(edges.begin(), edges.end(),
      [this](const Rung& edge) { return ring(edge.first).contains(edge.second); });
}

void Mesh::join(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
  const std::vector<bool>& alongFirst)
{
  assert(canJoin(first, second, alongFirst));
  const auto edges = stripEdges(first, second, alongFirst);
  const std::size_t count = edges.size();
  const auto begin = [&](bool along)
  {
    return std::size_t(std::find(alongFirst.begin(), alongFirst.end(), along) - alongFirst.begin());
  };

  // A vertex of the first loop gets its new neighbours behind its last one: first those of the
  // second loop that the strip comes to last.
  std::size_t place = 0;
  for (std::size_t step = begin(true), i = 0; i < count; step = (step + 1) % count, ++i)
  {
    Ring& ring = rings_[edges[step].first];
    place = alongFirst[step] ? ring.size() : place;
    ring.insert(unsigned(place), edges[step].second);
    ring.setOpen(false);
  }
  for (std::size_t step = begin(false), i = 0; i < count; step = (step + 1) % count, ++i)
  {
    Ring& ring = rings_[edges[step].second];
    ring.insert(ring.size(), edges[step].first);
    ring.setOpen(false);
  }
}

bool Mesh::canFill(VertexIndex v) const
{
  const Ring& ring = rings_[v];
  if (!ring.isOpen())
  {
    return false;
  }
  const VertexIndex before = ring.front();
  const VertexIndex after = ring.back();
  if (rings_[after].back() == before)
  {
    return ring.size() > 2; // the last triangle of a loop, unless it were the back of the only one
  }
  return !rings_[before].contains(after) && valence(before) < Ring::Capacity &&
    valence(after) < Ring::Capacity;
}

void Mesh::fill(VertexIndex v)
{
  assert(canFill(v));
  Ring& ring = rings_[v];
  Ring& before = rings_[ring.front()];
  Ring& after = rings_[ring.back()];
  ring.setOpen(false);
  if (after.back() == ring.front())
  {
    before.setOpen(false);
    after.setOpen(false);
    return;
  }
  before.insert(before.size(), ring.back());
  after.insert(0, ring.front());
}
}
