// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Call.h"

#include <cstdint>
#include <string>

namespace neuralmesh::binding
{
/// Points that are drawn from a file where they lie: `points`, and `RGB` and `normals` where the file has
/// some, and the CPU `seconds`; None if it was ended. Throws std::invalid_argument with a text that names
/// the file.
nanobind::object drawPoints(
  const std::string& path, std::uint64_t wanted, std::uint64_t seed, Call& call);
}
