// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Call.h"

#include <cstdint>
#include <string>

namespace neuralmesh::binding
{
/// What a file without a header is.
struct RawFile
{
  std::string numbers;    ///< "float" or "double"; empty for a file that has a header
  std::uint64_t skip = 0; ///< bytes before the first point
};

/// Points that are drawn from a file where they lie: `points`, and `RGB` and `normals` where the file has
/// some, the CPU `seconds`, and `file_points`, how many the file has; None if it was ended. Throws
/// std::invalid_argument with a text that names the file.
nanobind::object drawPoints(const std::string& path, const RawFile& raw, std::uint64_t wanted,
  std::uint64_t seed, Call& call);
}
