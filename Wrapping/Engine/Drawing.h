// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Call.h"

#include <cstdint>
#include <optional>
#include <string>

namespace neuralmesh::binding
{
/// Coordinates alone, of 4 or of 8 bytes each, behind so many bytes.
struct RawPoints
{
  bool isDouble = false;
  std::uint64_t skip = 0;
};

/// Points that are drawn from a file where they lie: `points`, and `RGB` and `normals` where the file has
/// some, none of these if it was ended; `count`, how many the file has, and the CPU `seconds`. Throws
/// std::invalid_argument with a text that names the file.
nanobind::dict drawPoints(const std::string& path, const std::optional<RawPoints>& raw,
  std::uint64_t wanted, std::uint64_t seed, Call& call);
}
