// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Mesh.h"

#include "base/Executor.h"
#include "base/TouchedVector.h"
#include "mesh/Renumbering.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// A part for an executor.
constexpr std::size_t MeshVerticesPerRange = 4096;
/// That memory is needed for when gaps are closed.
constexpr std::size_t VerticesTakenAtOnce = 65536;
}

Mesh::Mesh(LargeVector<Vector4> positions, LargeVector<Ring> rings)
  : rings_(std::move(rings))
  , positions_(std::move(positions))
  , vertexCount_(rings_.size())
{
  assert(positions_.size() == vertexCount_);
}

Mesh Mesh::tetrahedron(Vector4 center, float radius)
{
  const float r = radius / std::sqrt(3.f);
  Mesh mesh;
  for (const Vector4& corner :
    { Vector4(r, r, r), Vector4(r, -r, -r), Vector4(-r, r, -r), Vector4(-r, -r, r) })
  {
    mesh.newVertex(center + corner);
  }
  mesh.rings_[0].assign(std::array<VertexIndex, 3>{ 1, 2, 3 }, false);
  mesh.rings_[1].assign(std::array<VertexIndex, 3>{ 0, 3, 2 }, false);
  mesh.rings_[2].assign(std::array<VertexIndex, 3>{ 0, 1, 3 }, false);
  mesh.rings_[3].assign(std::array<VertexIndex, 3>{ 0, 2, 1 }, false);
  return mesh;
}

bool Mesh::isBoundaryEdge(VertexIndex a, VertexIndex b) const
{
  const Ring& ring = rings_[a];
  return ring.isOpen() && (ring.front() == b || ring.back() == b);
}

Vector4 Mesh::normal(VertexIndex v) const
{
  const Ring& ring = rings_[v];
  const Vector4 center = position(v);
  Vector4 sum;
  Vector4 previous = position(ring.isOpen() ? ring.front() : ring.back()) - center;
  for (const VertexIndex neighbor : ring)
  {
    const Vector4 current = position(neighbor) - center;
    sum += crossBeforeRotation(previous, current);
    previous = current;
  }
  return rotated(sum);
}

double Mesh::meanEdge() const { return meanEdge(Executor::sequential()); }

double Mesh::meanEdge(const Executor& executor) const
{
  // By ranges, each edge once: so it is the same on any number of threads.
  const double sum = executor.sum(indexEnd(), MeshVerticesPerRange,
    [this](std::size_t v)
    {
      double lengths = 0.;
      for (const VertexIndex neighbor : rings_[v])
      {
        lengths +=
          neighbor > v ? double(std::sqrt(squaredNorm(positions_[neighbor] - positions_[v]))) : 0.;
      }
      return lengths;
    });
  const double sides = executor.sum(
    indexEnd(), MeshVerticesPerRange, [this](std::size_t v) { return rings_[v].size(); });
  return 2. * sum / sides;
}

bool Mesh::isOpen() const { return isOpen(Executor::sequential()); }

bool Mesh::isOpen(const Executor& executor) const
{
  std::atomic<bool> result = false;
  executor.forEachRange(rings_.size(), MeshVerticesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      if (!result &&
        std::any_of(rings_.begin() + std::ptrdiff_t(begin), rings_.begin() + std::ptrdiff_t(end),
          [](const Ring& ring) { return !ring.isEmpty() && ring.isOpen(); }))
      {
        result = true;
      }
    });
  return result;
}

std::size_t Mesh::triangleCount() const
{
  std::size_t corners = 0;
  for (const Ring& ring : rings_)
  {
    corners += ring.isEmpty() ? 0 : ring.triangleCount();
  }
  return corners / 3;
}

bool Mesh::contains(const Triangle& triangle) const
{
  const Ring& ring = rings_[triangle[0]];
  const unsigned slot = ring.find(triangle[1]);
  return slot < ring.size() && ring.next(slot) == triangle[2];
}

bool Mesh::canSplit(VertexIndex v, unsigned first, unsigned steps) const
{
  const Ring& ring = rings_[v];
  const unsigned size = ring.size();
  if (steps < 1 || steps >= size || first >= size)
  {
    return false;
  }
  if (ring.isOpen())
  {
    const unsigned last = first + steps;
    const bool alongBoundary = (first == 0 && last < size) || last + 1 == size;
    if (!alongBoundary)
    {
      return false;
    }
    const VertexIndex inner = first == 0 ? ring[last] : ring[first];
    return valence(inner) < Ring::Capacity && steps + 2 <= Ring::Capacity;
  }
  return size + 2 - steps <= Ring::Capacity && steps + 2 <= Ring::Capacity &&
    valence(ring[first]) < Ring::Capacity &&
    valence(ring[ring.after(first, steps)]) < Ring::Capacity;
}

VertexIndex Mesh::split(VertexIndex v, unsigned first, unsigned steps, Vector4 position)
{
  const VertexIndex added = newVertex(position);
  properties_.resize(indexEnd());
  splitInto(v, first, steps, position, added);
  return added;
}

std::vector<VertexIndex> Mesh::addVertices(std::size_t count)
{
  std::vector<VertexIndex> added(count);
  for (VertexIndex& v : added)
  {
    v = newVertex(Vector4());
  }
  properties_.resize(indexEnd());
  return added;
}

void Mesh::splitInto(
  VertexIndex v, unsigned first, unsigned steps, Vector4 position, VertexIndex added)
{
  assert(canSplit(v, first, steps));
  positions_[added] = position;
  properties_.split(v, added);
  const Ring old = rings_[v];
  const bool open = old.isOpen();
  const bool startsAtBoundary = open && first == 0;
  const bool endsAtBoundary = open && !startsAtBoundary;

  std::array<VertexIndex, Ring::Capacity> taken{};
  for (unsigned i = 0; i <= steps; ++i)
  {
    taken[i] = old[old.after(first, i)];
  }
  const VertexIndex start = taken[0];
  const VertexIndex end = taken[steps];

  // The new ring: the neighbours taken over, and v between the last and the first of them.
  Ring& addedRing = rings_[added];
  addedRing.assign(std::span(taken).first(steps + 1), open);
  addedRing.insert(endsAtBoundary ? 0 : steps + 1, v);

  // What v keeps: from the end of the part taken over around to its start, and the new vertex.
  const unsigned kept = old.size() - steps + 1 - (open ? 1 : 0);
  std::array<VertexIndex, Ring::Capacity> rest{};
  const unsigned restBegin = endsAtBoundary ? 0 : old.after(first, steps);
  for (unsigned i = 0; i < kept; ++i)
  {
    rest[i] = old[old.after(restBegin, i)];
  }
  Ring& ring = rings_[v];
  ring.assign(std::span(rest).first(kept), open);
  ring.insert(startsAtBoundary ? 0 : kept, added);

  for (unsigned i = 0; i <= steps; ++i)
  {
    Ring& neighborRing = rings_[taken[i]];
    const unsigned slot = neighborRing.find(v);
    if (taken[i] == start && !startsAtBoundary)
    {
      neighborRing.insert(slot, added);
    }
    else if (taken[i] == end && !endsAtBoundary)
    {
      neighborRing.insert(slot + 1, added);
    }
    else
    {
      neighborRing.replace(slot, added);
    }
  }
}

bool Mesh::canCollapse(VertexIndex removed, VertexIndex kept) const
{
  const Ring& ring = rings_[removed];
  const Ring& keptRing = rings_[kept];
  const unsigned slot = ring.find(kept);
  if (slot == ring.size())
  {
    return false;
  }
  const VertexIndex left = ring.next(slot);
  const VertexIndex right = ring.previous(slot);
  const bool boundaryEdge = left == NoVertex || right == NoVertex;
  if (ring.isOpen() && !boundaryEdge)
  {
    return false;
  }
  // The opposite vertices lose an edge.
  for (const VertexIndex opposite : { left, right })
  {
    if (opposite != NoVertex && valence(opposite) <= (isBoundary(opposite) ? 2u : 3u))
    {
      return false;
    }
  }
  const unsigned valence = ring.size() + keptRing.size() - (boundaryEdge ? 3 : 4);
  if (valence > Ring::Capacity || valence < (keptRing.isOpen() ? 2u : 3u))
  {
    return false;
  }
  // Link condition: no common neighbours other than the opposite vertices.
  return std::none_of(ring.begin(), ring.end(),
    [&](VertexIndex neighbor)
    { return neighbor != left && neighbor != right && keptRing.contains(neighbor); });
}

void Mesh::collapse(VertexIndex removed, VertexIndex kept)
{
  collapseOnly(removed, kept);
  eraseVertex(removed);
}

void Mesh::eraseVertices(std::span<const VertexIndex> removed)
{
  for (const VertexIndex v : removed)
  {
    eraseVertex(v);
  }
}

void Mesh::collapseOnly(VertexIndex removed, VertexIndex kept)
{
  assert(canCollapse(removed, kept));
  const Ring ring = rings_[removed];
  Ring& keptRing = rings_[kept];
  const unsigned slot = ring.find(kept);
  const VertexIndex left = ring.next(slot);
  const VertexIndex right = ring.previous(slot);

  // In the ring of the kept vertex the removed one gives way to its other neighbours: from behind
  // the left opposite vertex around to before the right one.
  const unsigned opposites = (left == NoVertex ? 0u : 1u) + (right == NoVertex ? 0u : 1u);
  const unsigned inheritedCount = ring.size() - 1 - opposites;
  const unsigned inheritedBegin = left == NoVertex ? 0 : ring.after(slot, 2);
  unsigned place = keptRing.find(removed);
  keptRing.erase(place);
  for (unsigned i = 0; i < inheritedCount; ++i)
  {
    const VertexIndex inherited = ring[ring.after(inheritedBegin, i)];
    keptRing.insert(place++, inherited);
    Ring& inheritedRing = rings_[inherited];
    inheritedRing.replace(inheritedRing.find(removed), kept);
  }
  for (const VertexIndex opposite : { left, right })
  {
    if (opposite != NoVertex)
    {
      Ring& oppositeRing = rings_[opposite];
      oppositeRing.erase(oppositeRing.find(removed));
    }
  }
  rings_[removed].clear();
}

bool Mesh::canFlip(VertexIndex a, VertexIndex b) const
{
  const Ring& ring = rings_[a];
  const unsigned slot = ring.find(b);
  if (slot == ring.size())
  {
    return false;
  }
  const VertexIndex c = ring.next(slot);
  const VertexIndex d = ring.previous(slot);
  if (c == NoVertex || d == NoVertex)
  {
    return false;
  }
  const auto canLoseEdge = [this](VertexIndex v) { return valence(v) > (isBoundary(v) ? 2u : 3u); };
  return canLoseEdge(a) && canLoseEdge(b) && valence(c) < Ring::Capacity &&
    valence(d) < Ring::Capacity && !rings_[c].contains(d);
}

void Mesh::flip(VertexIndex a, VertexIndex b)
{
  assert(canFlip(a, b));
  Ring& ringA = rings_[a];
  Ring& ringB = rings_[b];
  const unsigned slot = ringA.find(b);
  const VertexIndex c = ringA.next(slot);
  const VertexIndex d = ringA.previous(slot);
  ringA.erase(slot);
  ringB.erase(ringB.find(a));
  Ring& ringC = rings_[c];
  ringC.insert(ringC.find(a) + 1, d);
  Ring& ringD = rings_[d];
  ringD.insert(ringD.find(b) + 1, c);
}

void Mesh::reserve(std::size_t count) { reserve(count, Executor::sequential()); }

void Mesh::reserve(std::size_t count, const Executor& executor)
{
  reserveTouched(rings_, count, executor);
  reserveTouched(positions_, count, executor);
  properties_.reserve(count);
  erased_.reserve(count);
  reusable_.reserve(count);
}

void Mesh::releaseErased()
{
  reusable_.insert(reusable_.end(), erased_.begin(), erased_.end());
  erased_.clear();
}

std::vector<VertexIndex> Mesh::dropErased() { return dropErased(Executor::sequential()); }

std::vector<VertexIndex> Mesh::dropErased(const Executor& executor)
{
  std::vector<VertexIndex> alive(vertexCount());
  if (vertexCount() == indexEnd())
  {
    std::iota(alive.begin(), alive.end(), VertexIndex(0));
    return alive;
  }
  std::size_t count = 0;
  for (VertexIndex v = 0; v < indexEnd(); ++v)
  {
    if (isAlive(v))
    {
      alive[count++] = v;
    }
  }
  renumber(alive, executor);
  return alive;
}

/// No vertex goes to where one lies that was not taken yet. So a few at a time need memory.
template <typename Take>
void Mesh::closeGaps(std::size_t count, const Take& take, const Executor& executor)
{
  const std::size_t most = std::min(count, VerticesTakenAtOnce);
  LargeVector<Ring> rings(most);
  LargeVector<Vector4> positions(most);
  for (std::size_t first = 0; first < count; first += most)
  {
    const std::size_t size = std::min(most, count - first);
    executor.forEachRange(size, MeshVerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          take(first + i, rings[i], positions[i]);
        }
      });
    executor.forEachRange(size, MeshVerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        std::copy(rings.begin() + std::ptrdiff_t(begin), rings.begin() + std::ptrdiff_t(end),
          rings_.begin() + std::ptrdiff_t(first + begin));
        std::copy(positions.begin() + std::ptrdiff_t(begin),
          positions.begin() + std::ptrdiff_t(end),
          positions_.begin() + std::ptrdiff_t(first + begin));
      });
  }
  rings_.resize(count);
  positions_.resize(count);
}

void Mesh::renumber(std::span<const VertexIndex> permutation)
{
  renumber(permutation, Executor::sequential());
}

void Mesh::renumber(std::span<const VertexIndex> permutation, const Executor& executor)
{
  assert(permutation.size() == vertexCount());
  const std::vector<VertexIndex> newIndex = newIndices(permutation, indexEnd(), executor);
  const auto take = [&](std::size_t i, Ring& ring, Vector4& position)
  {
    ring = rings_[permutation[i]];
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      ring.replace(slot, newIndex[ring[slot]]);
    }
    position = positions_[permutation[i]];
  };
  // Where most vertices go, so does their memory.
  const bool mostStay = permutation.size() > indexEnd() / 2;
  if (mostStay && std::is_sorted(permutation.begin(), permutation.end()))
  {
    closeGaps(permutation.size(), take, executor.uninterrupted());
  }
  else
  {
    auto rings = touchedVector<LargeVector<Ring>>(permutation.size(), executor);
    auto positions = touchedVector<LargeVector<Vector4>>(permutation.size(), executor);
    executor.forEachRange(permutation.size(), MeshVerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          take(i, rings[i], positions[i]);
        }
      });
    rings_ = std::move(rings);
    positions_ = std::move(positions);
  }
  properties_.renumber(permutation, executor.uninterrupted());
  erased_.clear();
  reusable_.clear();
}

void Mesh::reverseOrientation(std::span<const VertexIndex> component)
{
  for (const VertexIndex v : component)
  {
    const Ring old = ring(v);
    for (unsigned slot = 0; slot < old.size(); ++slot)
    {
      rings_[v].replace(slot, old[old.size() - 1 - slot]);
    }
  }
}

VertexIndex Mesh::newVertex(Vector4 position)
{
  ++vertexCount_;
  if (!reusable_.empty())
  {
    const VertexIndex v = reusable_.back();
    reusable_.pop_back();
    positions_[v] = position;
    return v;
  }
  rings_.emplace_back();
  positions_.push_back(position);
  return VertexIndex(rings_.size() - 1);
}

void Mesh::eraseVertex(VertexIndex v)
{
  rings_[v].clear();
  erased_.push_back(v);
  --vertexCount_;
}
}
