// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/TouchedVector.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// Sorts as std::stable_sort() does, on all threads: parts of the values first, which are then merged two by two.
template <typename Value, typename IsBefore>
void stableSort(std::vector<Value>& values, const IsBefore& isBefore, const Executor& executor)
{
  constexpr std::size_t LeastOfPart = 4096, MostParts = 64;
  const std::size_t count = values.size();
  const std::size_t part = std::max(LeastOfPart, (count + MostParts - 1) / MostParts);
  const auto at = [&](std::vector<Value>& some, std::size_t place)
  { return some.begin() + std::ptrdiff_t(std::min(place, count)); };
  executor.forEachRange(count, part,
    [&](std::size_t begin, std::size_t end)
    { std::stable_sort(at(values, begin), at(values, end), isBefore); });
  auto merged = touchedVector<std::vector<Value>>(part < count ? count : 0, executor);
  for (std::size_t sorted = part; sorted < count; sorted *= 2)
  {
    executor.forEachRange(count, 2 * sorted,
      [&](std::size_t begin, std::size_t end)
      {
        std::merge(at(values, begin), at(values, begin + sorted), at(values, begin + sorted),
          at(values, end), at(merged, begin), isBefore);
      });
    values.swap(merged);
  }
}
}
