// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace neuralmesh
{
/// Sorts some hundred values whose places are spread about evenly from 0 to 1, into `sorted`: by buckets of which
/// most hold one. That takes hardly a comparison whose outcome is chance, which is what other ways to sort so few
/// spend their time on. Others are sorted, too, only more slowly. `placeOf(value)` must not fall from a value to a
/// larger one; what is no number, or beyond the ends, counts as one of these.
template <typename Value, typename PlaceOf>
void sortEven(std::span<const Value> values, std::span<Value> sorted, const PlaceOf& placeOf)
{
  constexpr std::size_t Buckets = 128;
  constexpr std::uint32_t MostByInsertion = 8;
  using Place = decltype(placeOf(values[0]));
  const auto bucketOf = [&](const Value& value)
  {
    const Place at = Place(Buckets) * placeOf(value);
    return std::size_t(std::min(std::max(Place(0), at), Place(Buckets - 1)));
  };
  std::array<std::uint32_t, Buckets> ends{};
  for (const Value& value : values)
  {
    ++ends[bucketOf(value)];
  }
  std::uint32_t sum = 0, most = 0;
  for (std::uint32_t& end : ends)
  {
    most = std::max(most, end);
    end = sum += end;
  }
  for (const Value& value : values)
  {
    sorted[--ends[bucketOf(value)]] = value;
  }
  if (most > MostByInsertion)
  {
    std::sort(sorted.begin(), sorted.begin() + std::ptrdiff_t(values.size()));
    return;
  }
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    const Value value = sorted[i];
    std::size_t at = i;
    for (; at > 0 && value < sorted[at - 1]; --at)
    {
      sorted[at] = sorted[at - 1];
    }
    sorted[at] = value;
  }
}
}
