// SPDX-License-Identifier: BSD-3-Clause
// The operations of a mesh that make and close boundaries.
#include "Mesh.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The edges across a strip, as it is walked once around; the first edge is the last.
std::vector<std::pair<VertexIndex, VertexIndex>> stripEdges(std::span<const VertexIndex> first,
  std::span<const VertexIndex> second, const std::vector<bool>& alongFirst)
{
  std::vector<std::pair<VertexIndex, VertexIndex>> edges;
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
}

Mesh::RemovedTriangle Mesh::removeTriangle(const Triangle& triangle)
{
  RemovedTriangle result;
  // Where a fan falls into two: the slot of the last neighbour of its first part.
  std::array<int, 3> gaps{ -1, -1, -1 };
  for (unsigned corner = 0; corner < 3; ++corner)
  {
    Ring& ring = this->rings_[triangle[corner]];
    const unsigned slot = ring.find(triangle[(corner + 1) % 3]);
    assert(ring.next(slot) == triangle[(corner + 2) % 3]);
    if (!ring.isOpen())
    {
      ring.rotateToFront(ring.after(slot));
      ring.setOpen(true);
    }
    else if (slot == 0)
    {
      ring.erase(0);
    }
    else if (slot + 2 == ring.size())
    {
      ring.erase(slot + 1);
    }
    else
    {
      gaps[corner] = int(slot);
    }
  }
  for (unsigned corner = 0; corner < 3; ++corner)
  {
    const VertexIndex v = triangle[corner];
    if (gaps[corner] >= 0)
    {
      const Ring ring = this->ring(v);
      const unsigned firstCount = unsigned(gaps[corner]) + 1;
      const std::span<const VertexIndex> all(ring.begin(), ring.end());
      const auto first = all.first(firstCount);
      const auto second = all.subspan(firstCount);
      const bool keepFirst = first.size() >= second.size();
      const auto smaller = keepFirst ? second : first;
      const VertexIndex duplicate = this->newVertex(this->position(v));
      this->rings_[v].assign(keepFirst ? first : second, true);
      this->rings_[duplicate].assign(smaller, true);
      for (const VertexIndex neighbor : smaller)
      {
        Ring& neighborRing = this->rings_[neighbor];
        neighborRing.replace(neighborRing.find(v), duplicate);
      }
      result.duplicates[corner] = { v, duplicate };
    }
    else if (this->valence(v) < 2)
    {
      this->eraseVertex(v);
      result.erased[corner] = v;
    }
  }
  return result;
}

bool Mesh::canJoin(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
  const std::vector<bool>& alongFirst) const
{
  std::vector<std::pair<VertexIndex, VertexIndex>> edges = stripEdges(first, second, alongFirst);
  const auto fits = [&](VertexIndex v, auto end)
  {
    const auto added =
      std::count_if(edges.begin(), edges.end(), [&](const auto& edge) { return edge.*end == v; });
    return this->valence(v) + unsigned(added) <= Ring::Capacity;
  };
  using Edge = std::pair<VertexIndex, VertexIndex>;
  const bool allFit =
    std::all_of(first.begin(), first.end(), [&](VertexIndex v) { return fits(v, &Edge::first); }) &&
    std::all_of(
      second.begin(), second.end(), [&](VertexIndex v) { return fits(v, &Edge::second); });
  std::sort(edges.begin(), edges.end());
  return allFit && std::adjacent_find(edges.begin(), edges.end()) == edges.end() &&
    std::none_of(edges.begin(), edges.end(),
      [this](const Edge& edge) { return this->ring(edge.first).contains(edge.second); });
}

void Mesh::join(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
  const std::vector<bool>& alongFirst)
{
  assert(this->canJoin(first, second, alongFirst));
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
    Ring& ring = this->rings_[edges[step].first];
    place = alongFirst[step] ? ring.size() : place;
    ring.insert(unsigned(place), edges[step].second);
    ring.setOpen(false);
  }
  for (std::size_t step = begin(false), i = 0; i < count; step = (step + 1) % count, ++i)
  {
    Ring& ring = this->rings_[edges[step].second];
    ring.insert(ring.size(), edges[step].first);
    ring.setOpen(false);
  }
}

bool Mesh::canFill(VertexIndex v) const
{
  const Ring& ring = this->ring(v);
  const VertexIndex before = ring.front();
  const VertexIndex after = ring.back();
  if (this->ring(after).back() == before)
  {
    return ring.size() > 2; // the last triangle of a loop, unless it were the back of the only one
  }
  return !this->ring(before).contains(after) && this->valence(before) < Ring::Capacity &&
    this->valence(after) < Ring::Capacity;
}

void Mesh::fill(VertexIndex v)
{
  assert(this->isBoundary(v) && this->canFill(v));
  Ring& ring = this->rings_[v];
  Ring& before = this->rings_[ring.front()];
  Ring& after = this->rings_[ring.back()];
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
