// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NarrowHandles.h"

#include "mesh/Pieces.h"

#include <algorithm>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Strips that are cut one by one, to find the place of a handle, and places that are wanted.
constexpr std::size_t MostStripsTried = 32;
constexpr std::size_t MostPlaces = 2;
}

NarrowHandles findNarrowHandles(const Mesh& mesh, const Executor& executor)
{
  return genusOf(mesh, executor) == 0
    ? NarrowHandles()
    : findNarrowHandles(mesh, findNarrowStrips(mesh, executor), executor);
}

NarrowHandles findNarrowHandles(
  const Mesh& mesh, std::span<const NarrowStrip> strips, const Executor& executor)
{
  NarrowHandles result;
  const long all = strips.empty() ? 0 : genusOf(mesh, executor);
  if (all == 0)
  {
    return result;
  }
  Mesh rest = mesh;
  long left = all;
  for (std::size_t i = 0; i < strips.size(); ++i)
  {
    cutStrip(rest, strips[i]);
    if (i < MostStripsTried && result.places.size() < MostPlaces)
    {
      const long before = left;
      left = genusOf(rest, executor);
      if (left < before)
      {
        result.places.push_back(mesh.position(strips[i].front()));
      }
    }
  }
  result.count = std::size_t(std::max(0L, all - genusOf(rest, executor)));
  return result;
}
}
