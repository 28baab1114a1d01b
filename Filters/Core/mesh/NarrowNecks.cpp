// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NarrowNecks.h"

#include "base/DisjointSets.h"
#include "mesh/Pieces.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A part is large if it has so much of the area.
constexpr double LeastPartAtNeck = 0.002;
constexpr std::size_t MostPlacesOfNecks = 2;
}

NarrowNecks findNarrowNecks(
  const Mesh& mesh, std::span<const NarrowStrip> strips, const Executor& executor)
{
  NarrowNecks result;
  if (strips.empty())
  {
    return result;
  }
  Mesh rest = mesh;
  for (const NarrowStrip& strip : strips)
  {
    cutStrip(rest, strip);
  }
  constexpr std::uint32_t NoPart = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> partOf(mesh.indexEnd(), NoPart);
  const double least = LeastPartAtNeck * areaOf(mesh, executor);
  std::uint32_t parts = 0;
  for (const Piece& piece : findPieces(rest, executor))
  {
    if (piece.area >= least)
    {
      for (const VertexIndex v : piece.vertices)
      {
        partOf[v] = parts;
      }
      ++parts;
    }
  }
  DisjointSets joined(parts);
  for (const NarrowStrip& strip : strips)
  {
    std::uint32_t first = NoPart;
    bool isNeck = false;
    for (const VertexIndex v : strip)
    {
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        const std::uint32_t part = partOf[neighbor];
        if (part != NoPart && first != NoPart && !joined.areJoined(part, first))
        {
          joined.join(part, first);
          isNeck = true;
        }
        first = first == NoPart ? part : first;
      }
    }
    if (isNeck)
    {
      ++result.count;
      if (result.places.size() < MostPlacesOfNecks)
      {
        result.places.push_back(mesh.position(strip.front()));
      }
    }
  }
  return result;
}
}
