// SPDX-License-Identifier: BSD-3-Clause
#include "base/Morton.h"

#include "base/TouchedVector.h"
#include "base/ZeroedArray.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr int BitsPerDigit = 12;
constexpr std::size_t DigitCount = std::size_t(1) << BitsPerDigit;
/// Parts for the executor, about so many, but none smaller than there are digits to count.
constexpr std::size_t PartsOfSort = 64;
constexpr std::size_t DigitsPerRange = 1024;
constexpr std::size_t LeastSortedPerRange = 4 * DigitCount;

std::size_t sortedPerRange(std::size_t count)
{
  return std::max(LeastSortedPerRange, count / PartsOfSort);
}

struct MortonEntry
{
  std::uint64_t key;
  std::uint32_t index;
};

/// Sorts by the digit of the keys that begins at the bit `shift`; entries of the same digit keep
/// their order.
void sortByDigit(const ZeroedArray<MortonEntry>& entries, ZeroedArray<MortonEntry>& sorted,
  int shift, const Executor& executor)
{
  const auto digit = [shift](const MortonEntry& entry)
  { return std::size_t(entry.key >> shift) % DigitCount; };
  // Where the entries of each digit in each range go.
  const std::size_t grain = sortedPerRange(entries.size());
  const std::size_t ranges = (entries.size() + grain - 1) / grain;
  std::vector<std::uint32_t> places(ranges * DigitCount);
  executor.forEachRange(entries.size(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::uint32_t* const counts = &places[begin / grain * DigitCount];
      for (std::size_t i = begin; i < end; ++i)
      {
        ++counts[digit(entries[i])];
      }
    });
  // Within each digit first, then behind those of lower digits.
  std::vector<std::uint32_t> digitCounts(DigitCount);
  executor.forEachRange(DigitCount, DigitsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t range = 0; range < ranges; ++range)
      {
        for (std::size_t d = begin; d < end; ++d)
        {
          digitCounts[d] += std::exchange(places[range * DigitCount + d], digitCounts[d]);
        }
      }
    });
  std::exclusive_scan(digitCounts.begin(), digitCounts.end(), digitCounts.begin(), 0u);
  executor.forEachRange(entries.size(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      std::uint32_t* const place = &places[begin / grain * DigitCount];
      for (std::size_t d = 0; d < DigitCount; ++d)
      {
        place[d] += digitCounts[d];
      }
      for (std::size_t i = begin; i < end; ++i)
      {
        sorted[place[digit(entries[i])]++] = entries[i];
      }
    });
}
}

MortonCurve::MortonCurve(Vector4 boxMin, Vector4 boxMax)
  : boxMin_(boxMin)
  , boxMax_(boxMax)
{
  const Vector4 extent = boxMax - boxMin;
  const float longest = std::max({ extent[0], extent[1], extent[2] });
  // Of the smallest boxes there is no inverse.
  scale_ = longest > 0.f
    ? std::min(float((1 << BitsPerAxis) - 1) / longest, std::numeric_limits<float>::max())
    : 0.f;
}

std::vector<std::uint32_t> mortonOrder(
  std::span<const Vector4> points, Vector4 boxMin, Vector4 boxMax, const Executor& executor)
{
  const MortonCurve curve(boxMin, boxMax);
  const std::size_t grain = sortedPerRange(points.size());
  ZeroedArray<MortonEntry> entries(points.size()), sorted(points.size());
  touchPages(sorted.data(), sorted.size() * sizeof(MortonEntry), executor);
  executor.forEachRange(points.size(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        entries[i] = { curve.key(points[i]), std::uint32_t(i) };
      }
    });
  for (int shift = 0; shift < MortonCurve::KeyBits; shift += BitsPerDigit)
  {
    sortByDigit(entries, sorted, shift, executor);
    std::swap(entries, sorted);
  }
  sorted = {};
  std::vector<std::uint32_t> order(points.size());
  executor.forEachRange(points.size(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        order[i] = entries[i].index;
      }
    });
  return order;
}
}
