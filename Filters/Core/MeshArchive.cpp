// SPDX-License-Identifier: BSD-3-Clause
// How a mesh is written and read, and what makes one that was read a mesh.
#include "Archive.h"
#include "Mesh.h"

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
  const std::size_t count = archive.count(this->indexEnd(), LeastBytes);
  this->rings_.resize(count);
  this->positions_.resize(count);
  for (std::size_t v = 0; v < count; ++v)
  {
    exchangeRing(archive, this->rings_[v]);
    exchangePosition(archive, this->positions_[v]);
  }
  archive(this->erased_, this->reusable_);
  if (archive.isReading())
  {
    this->vertexCount_ = std::size_t(std::count_if(
      this->rings_.begin(), this->rings_.end(), [](const Ring& ring) { return !ring.isEmpty(); }));
    archive.require(this->isSound());
  }
}

/// Whether the rings are those of an oriented 2-manifold, and the lists hold the erased vertices.
bool Mesh::isSound() const
{
  const auto isNeighbor = [this](VertexIndex v, VertexIndex neighbor)
  {
    return neighbor < this->indexEnd() && this->ring(neighbor).contains(v) &&
      std::count(this->ring(v).begin(), this->ring(v).end(), neighbor) == 1;
  };
  for (VertexIndex v = 0; v < this->indexEnd(); ++v)
  {
    const Ring& ring = this->ring(v);
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
      if (!this->contains({ ring[slot], ring[ring.after(slot)], v }))
      {
        return false;
      }
    }
  }
  std::vector<bool> isErased(this->indexEnd(), false);
  for (const std::vector<VertexIndex>* list : { &this->erased_, &this->reusable_ })
  {
    for (const VertexIndex v : *list)
    {
      if (v >= this->indexEnd() || this->isAlive(v) || isErased[v])
      {
        return false;
      }
      isErased[v] = true;
    }
  }
  return this->vertexCount_ + this->erased_.size() + this->reusable_.size() == this->indexEnd();
}
}
