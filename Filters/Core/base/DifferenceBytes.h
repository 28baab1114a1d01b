// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

namespace neuralmesh
{
// Indices as differences to others that are near, the sign in the lowest bit, seven bits a byte: what is nearer than 64
// takes one byte.

inline std::uint32_t withSignLast(std::uint32_t index, std::uint32_t other)
{
  const std::uint32_t difference = index - other;
  return difference << 1 ^ (0u - (difference >> 31));
}

/// How many bytes it takes.
inline std::size_t sizeOfDifference(std::uint32_t index, std::uint32_t other)
{
  return std::size_t(std::bit_width(withSignLast(index, other) | 1u) + 6) / 7;
}

/// Puts it to `bytes`, which goes on to what comes behind it.
inline void writeDifference(std::uint8_t*& bytes, std::uint32_t index, std::uint32_t other)
{
  std::uint32_t left = withSignLast(index, other);
  for (; left >= 0x80; left >>= 7)
  {
    *bytes++ = std::uint8_t(left | 0x80);
  }
  *bytes++ = std::uint8_t(left);
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
