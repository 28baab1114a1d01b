// SPDX-License-Identifier: BSD-3-Clause
// How a mesh is written and read, and what makes one that was read a mesh.
#include "base/Archive.h"
#include "mesh/Mesh.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
constexpr std::uint8_t OpenBit = 0x80;
/// Of a vertex: the size of its ring and its position.
constexpr std::size_t LeastBytes = 1 + 3 * sizeof(float);
/// So that squares of distances stay finite. No vertex is farther off than the points of a cloud.
constexpr float FarthestPosition = 1e12f;

void exchangeRing(Archive& archive, Ring& ring)
{
  auto size = std::uint8_t(ring.size() | (ring.isOpen() ? OpenBit : 0));
  archive(size);
  const bool isOpen = (size & OpenBit) != 0;
  size &= std::uint8_t(~OpenBit);
  archive.require(size <= Ring::Capacity);
  std::array<VertexIndex, Ring::Capacity> neighbors{};
  std::copy(ring.begin(), ring.end(), neighbors.begin());
  std::span<VertexIndex> used = std::span(neighbors).first(size);
  archive(used);
  if (archive.isReading())
  {
    ring.assign(used, isOpen);
  }
}

void exchangePosition(Archive& archive, Vector4& position)
{
  float x = position[0], y = position[1], z = position[2];
  archive(x, y, z);
  position = Vector4(x, y, z);
  archive.require(
    std::fmax(std::fabs(x), std::fmax(std::fabs(y), std::fabs(z))) <= FarthestPosition &&
    !std::isnan(x + y + z));
}
}

void Mesh::exchange(Archive& archive)
{
  const std::size_t count = archive.count(indexEnd(), LeastBytes);
  rings_.resize(count);
  positions_.resize(count);
  for (std::size_t v = 0; v < count; ++v)
  {
    exchangeRing(archive, rings_[v]);
    exchangePosition(archive, positions_[v]);
  }
  properties_.exchange(archive, count);
  archive(erased_, reusable_);
  if (archive.isReading())
  {
    vertexCount_ = std::size_t(std::count_if(
      rings_.begin(), rings_.end(), [](const Ring& ring) { return !ring.isEmpty(); }));
    archive.require(isSound());
  }
}

/// Whether the rings are those of an oriented 2-manifold, and the lists hold the erased vertices.
bool Mesh::isSound() const
{
  const auto isNeighbor = [this](VertexIndex v, VertexIndex neighbor)
  {
    return neighbor < indexEnd() && rings_[neighbor].contains(v) &&
      std::count(rings_[v].begin(), rings_[v].end(), neighbor) == 1;
  };
  for (VertexIndex v = 0; v < indexEnd(); ++v)
  {
    const Ring& ring = rings_[v];
    if (ring.isEmpty())
    {
      continue;
    }
    if (ring.size() < (ring.isOpen() ? 2u : 3u) || ring.contains(v) ||
      !std::all_of(
        ring.begin(), ring.end(), [&](VertexIndex neighbor) { return isNeighbor(v, neighbor); }))
    {
      return false;
    }
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      if (!contains({ ring[slot], ring[ring.after(slot)], v }))
      {
        return false;
      }
    }
  }
  std::vector<bool> isErased(indexEnd(), false);
  for (const std::vector<VertexIndex>* list : { &erased_, &reusable_ })
  {
    for (const VertexIndex v : *list)
    {
      if (v >= indexEnd() || isAlive(v) || isErased[v])
      {
        return false;
      }
      isErased[v] = true;
    }
  }
  return vertexCount_ + erased_.size() + reusable_.size() == indexEnd();
}
}
