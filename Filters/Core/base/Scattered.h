// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace neuralmesh
{
/// A bijection: where vertices are equal, it chooses them here and there, not side by side.
inline std::uint32_t scattered(std::uint32_t x)
{
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}
}
