// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/StoredMesh.h"

#include "base/DifferenceBytes.h"

#include <array>
#include <span>

namespace neuralmesh
{
namespace
{
constexpr std::size_t RingsOfBlock = 4096;
constexpr std::uint8_t OpenRing = 0x80;

void writeRing(std::vector<std::uint8_t>& bytes, VertexIndex v, const Ring& ring)
{
  bytes.push_back(std::uint8_t(ring.size() | (ring.isOpen() ? OpenRing : 0)));
  for (const VertexIndex neighbor : ring)
  {
    writeDifference(bytes, neighbor, v);
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
  , rings_((mesh.indexEnd() + RingsOfBlock - 1) / RingsOfBlock)
{
  rest_.properties_ = mesh.properties_;
  rest_.erased_ = mesh.erased_;
  rest_.reusable_ = mesh.reusable_;
  rest_.vertexCount_ = mesh.vertexCount_;
  executor.forEachRange(indexEnd_, RingsOfBlock,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::uint8_t> bytes;
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        writeRing(bytes, v, mesh.ring(v));
        positions_.set(v, mesh.position(v));
      }
      rings_[begin / RingsOfBlock] = { bytes.begin(), bytes.end() };
    });
}

Mesh StoredMesh::mesh(const Executor& executor) const
{
  Mesh result = rest_;
  result.rings_.resize(indexEnd_);
  result.positions_.resize(indexEnd_);
  executor.forEachRange(indexEnd_, RingsOfBlock,
    [&](std::size_t begin, std::size_t end)
    {
      const std::uint8_t* bytes = rings_[begin / RingsOfBlock].data();
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        readRing(bytes, v, result.rings_[v]);
        result.positions_[v] = positions_[v];
      }
    });
  return result;
}
}
