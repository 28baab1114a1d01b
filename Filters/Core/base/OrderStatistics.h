// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The value that has the place `rank` (from 0 on) among numbers once they are sorted. They are not
/// copied: `forEachNumber(use)` calls `use(number)` for each of them, in any order, and is called four
/// times. None may be NaN, and there must be more than `rank`.
template <typename ForEachNumber>
double orderStatistic(std::size_t rank, const ForEachNumber& forEachNumber)
{
  constexpr int BitsPerDigit = 16;
  constexpr std::uint64_t Sign = std::uint64_t(1) << 63;
  // Whole numbers in the order of the numbers: those below zero have the order of their bits reversed.
  const auto keyOf = [](double number)
  {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    return bits & Sign ? ~bits : bits | Sign;
  };
  std::uint64_t key = 0;
  for (int shift = 64 - BitsPerDigit; shift >= 0; shift -= BitsPerDigit)
  {
    // Of those that begin with the digits known so far, by the next one.
    std::vector<std::uint32_t> counts(std::size_t(1) << BitsPerDigit, 0);
    forEachNumber(
      [&](double number)
      {
        const std::uint64_t own = keyOf(number);
        const bool begins = shift + BitsPerDigit == 64 || own >> (shift + BitsPerDigit) == key;
        counts[(own >> shift) % counts.size()] += begins ? 1 : 0;
      });
    std::size_t digit = 0;
    for (; rank >= counts[digit]; ++digit)
    {
      rank -= counts[digit];
    }
    key = key << BitsPerDigit | digit;
  }
  return std::bit_cast<double>(key & Sign ? key & ~Sign : ~key);
}
}
