// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxTree.h"

namespace neuralmesh
{
namespace
{
/// Of a tree, and of one with an item more: halves differ by one at most.
std::array<std::uint32_t, 2> nodeCounts(std::uint32_t items)
{
  constexpr std::uint32_t Most = BoxTreeShape::ItemsOfLeaf;
  if (items < Most)
  {
    return { items > 0 ? 1u : 0u, 1u };
  }
  const auto [half, more] = nodeCounts(items / 2);
  const std::uint32_t even = 1 + 2 * half, odd = 1 + half + more;
  if (items == Most)
  {
    return { 1, odd };
  }
  return items % 2 == 0 ? std::array{ even, odd } : std::array{ odd, 1 + 2 * more };
}
}

std::uint32_t BoxTreeShape::nodeCount(std::uint32_t items) { return nodeCounts(items)[0]; }
}
