// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace neuralmesh::testing
{
/// Of a number, in either order.
template <typename Number>
std::string bytesOf(Number number, bool isBigEndian = false)
{
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  if (isBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return { bytes.begin(), bytes.end() };
}
}
