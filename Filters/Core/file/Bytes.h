// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace neuralmesh
{
/// Appends numbers as they are in memory, which is little-endian.
template <typename Number>
void appendBytes(std::string& bytes, const Number* numbers, std::size_t count)
{
  bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}
}
