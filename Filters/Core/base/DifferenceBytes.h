// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace neuralmesh
{
// Indices as differences to others that are near, the sign in the lowest bit, seven bits a byte: what is nearer than 64
// takes one byte.

inline void writeDifference(
  std::vector<std::uint8_t>& bytes, std::uint32_t index, std::uint32_t other)
{
  const std::uint32_t difference = index - other;
  std::uint32_t left = difference << 1 ^ (0u - (difference >> 31));
  for (; left >= 0x80; left >>= 7)
  {
    bytes.push_back(std::uint8_t(left | 0x80));
  }
  bytes.push_back(std::uint8_t(left));
}

/// Takes the index from `bytes`, which goes on to what comes behind it.
inline std::uint32_t readDifference(const std::uint8_t*& bytes, std::uint32_t other)
{
  std::uint32_t difference = 0;
  for (unsigned shift = 0;; shift += 7)
  {
    const std::uint8_t byte = *bytes++;
    difference |= std::uint32_t(byte & 0x7f) << shift;
    if (byte < 0x80)
    {
      return other + (difference >> 1 ^ (0u - (difference & 1)));
    }
  }
}
}
