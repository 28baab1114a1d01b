// SPDX-License-Identifier: BSD-3-Clause
#include "Morton.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace neuralmesh
{
namespace
{
constexpr int BitsPerAxis = 16;

/// Spreads the bits of a 16-bit number so that two zeros follow each.
std::uint64_t spread(std::uint32_t bits)
{
  std::uint64_t x = bits;
  x = (x | x << 16) & 0x0000ff0000ffu;
  x = (x | x << 8) & 0x00f00f00f00fu;
  x = (x | x << 4) & 0x0c30c30c30c3u;
  x = (x | x << 2) & 0x249249249249u;
  return x;
}
}

std::vector<std::uint32_t> mortonOrder(
  std::span<const Vector4> points, Vector4 boxMin, Vector4 boxMax)
{
  const Vector4 extent = boxMax - boxMin;
  const float longest = std::max({ extent[0], extent[1], extent[2] });
  // Of the smallest boxes there is no inverse.
  const float scale = longest > 0.f
    ? std::min(float((1 << BitsPerAxis) - 1) / longest, std::numeric_limits<float>::max())
    : 0.f;

  struct Entry
  {
    std::uint64_t key;
    std::uint32_t index;
  };
  std::vector<Entry> entries(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector4 p = scale * (min(max(points[i], boxMin), boxMax) - boxMin);
    entries[i] = { spread(std::uint32_t(p[0])) | spread(std::uint32_t(p[1])) << 1 |
        spread(std::uint32_t(p[2])) << 2,
      std::uint32_t(i) };
  }

  // Radix sort, 12 bits at a time.
  constexpr int digitBits = 12;
  std::vector<Entry> sorted(entries.size());
  std::vector<std::uint32_t> begin((1u << digitBits) + 1);
  for (int shift = 0; shift < 3 * BitsPerAxis; shift += digitBits)
  {
    const auto digit = [shift](const Entry& entry)
    { return (entry.key >> shift) & ((1u << digitBits) - 1); };
    std::fill(begin.begin(), begin.end(), 0u);
    for (const Entry& entry : entries)
    {
      ++begin[digit(entry) + 1];
    }
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    for (const Entry& entry : entries)
    {
      sorted[begin[digit(entry)]++] = entry;
    }
    entries.swap(sorted);
  }

  std::vector<std::uint32_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = entries[i].index;
  }
  return order;
}
}
