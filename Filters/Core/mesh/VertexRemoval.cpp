// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/VertexRemoval.h"

#include "mesh/EdgeFlips.h"

#include <array>

namespace neuralmesh
{
Vector4 positionAfterFullCollapse(const Mesh& mesh, VertexIndex removed, VertexIndex kept)
{
  if (mesh.isBoundary(removed) != mesh.isBoundary(kept))
  {
    return mesh.position(kept);
  }
  return 0.5f * (mesh.position(removed) + mesh.position(kept));
}

unsigned triangulateAnew(Mesh& mesh, const Ring& polygon, VertexIndex kept)
{
  struct Diagonal
  {
    VertexIndex a;
    VertexIndex b;
  };
  std::array<Diagonal, Ring::Capacity> diagonals{};
  unsigned count = 0;
  const unsigned slot = polygon.find(kept);
  for (const VertexIndex v : polygon)
  {
    if (v != kept && v != polygon.next(slot) && v != polygon.previous(slot))
    {
      diagonals[count++] = { kept, v };
    }
  }
  unsigned flips = 0;
  // Each flip lowers the sum of the squared excesses of valence, so there is an end.
  for (bool improved = true; improved;)
  {
    improved = false;
    for (unsigned i = 0; i < count; ++i)
    {
      const auto [a, b] = diagonals[i];
      const Ring& ring = mesh.ring(a);
      const unsigned slotOfB = ring.find(b);
      const Diagonal flipped{ ring.next(slotOfB), ring.previous(slotOfB) };
      if (flipIfMoreRegular(mesh, a, b))
      {
        diagonals[i] = flipped;
        improved = true;
        ++flips;
      }
    }
  }
  return flips;
}
}
