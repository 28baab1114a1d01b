// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/StoredMesh.h"

#include "base/DifferenceBytes.h"
#include "base/TouchedVector.h"

#include <array>
#include <span>

namespace neuralmesh
{
namespace
{
constexpr std::uint8_t OpenRing = 0x80;

std::size_t sizeOfRings(const Mesh& mesh, std::size_t begin, std::size_t end)
{
  std::size_t size = end - begin;
  for (auto v = VertexIndex(begin); v < end; ++v)
  {
    for (const VertexIndex neighbor : mesh.ring(v))
    {
      size += sizeOfDifference(neighbor, v);
    }
  }
  return size;
}

void writeRings(std::uint8_t* bytes, const Mesh& mesh, std::size_t begin, std::size_t end)
{
  for (auto v = VertexIndex(begin); v < end; ++v)
  {
    const Ring& ring = mesh.ring(v);
    *bytes++ = std::uint8_t(ring.size() | (ring.isOpen() ? OpenRing : 0));
    for (const VertexIndex neighbor : ring)
    {
      writeDifference(bytes, neighbor, v);
    }
  }
}

/// Goes on to what comes behind it.
void readRing(const std::uint8_t*& bytes, VertexIndex v, Ring& ring)
{
  const std::uint8_t head = *bytes++;
  std::array<VertexIndex, Ring::Capacity> neighbors{};
  const std::span<VertexIndex> used = std::span(neighbors).first(head & ~OpenRing);
  for (VertexIndex& neighbor : used)
  {
    neighbor = readDifference(bytes, v);
  }
  ring.assign(used, (head & OpenRing) != 0);
}
}

StoredMesh::StoredMesh(const Mesh& mesh, const Executor& executor)
  : indexEnd_(mesh.indexEnd())
  , positions_(mesh.indexEnd())
  , rings_(
      mesh.indexEnd(), executor,
      [&](std::size_t begin, std::size_t end) { return sizeOfRings(mesh, begin, end); },
      [&](std::uint8_t* bytes, std::size_t begin, std::size_t end)
      {
        writeRings(bytes, mesh, begin, end);
        for (std::size_t v = begin; v < end; ++v)
        {
          positions_.set(v, mesh.position(VertexIndex(v)));
        }
      })
{
  rest_.properties_ = mesh.properties_;
  rest_.erased_ = mesh.erased_;
  rest_.reusable_ = mesh.reusable_;
  rest_.vertexCount_ = mesh.vertexCount_;
}

Mesh StoredMesh::mesh(const Executor& executor) const
{
  Mesh result = rest_;
  result.rings_ = touchedVector<LargeVector<Ring>>(indexEnd_, executor);
  result.positions_ = touchedVector<LargeVector<Vector4>>(indexEnd_, executor);
  executor.forEachRange(indexEnd_, ByteBlocks::ItemsOfBlock,
    [&](std::size_t begin, std::size_t end)
    {
      const std::uint8_t* bytes = rings_.from(begin);
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        readRing(bytes, v, result.rings_[v]);
        result.positions_[v] = positions_[v];
      }
    });
  return result;
}
}
