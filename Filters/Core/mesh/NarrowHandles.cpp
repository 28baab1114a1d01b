// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NarrowHandles.h"

#include "mesh/NarrowStrips.h"
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
  NarrowHandles result;
  const long all = genusOf(mesh, executor);
  if (all == 0)
  {
    return result;
  }
  const std::vector<NarrowStrip> strips = findNarrowStrips(mesh, executor);
  if (strips.empty())
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
