// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// What LZF has compressed to `bytes`, as .pcd has it: literal runs, and copies of what came before.
/// Throws std::runtime_error if it is not `size` bytes, without holding more than the compressed bytes
/// can become.
std::string decompressLzf(std::string_view bytes, std::size_t size);
}
