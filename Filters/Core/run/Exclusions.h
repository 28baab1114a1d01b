// SPDX-License-Identifier: BSD-3-Clause
// What does not go with a run of some kind.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// Something else that a run may be asked for.
struct AskedBeside
{
  bool isThere;
  std::string_view name;
};

/// The sentence that `wanted` and the first of these that is there exclude each other; empty if none is.
inline std::string whyExcluded(std::string_view wanted, std::initializer_list<AskedBeside> beside)
{
  const auto* const first = std::ranges::find_if(beside, &AskedBeside::isThere);
  return first != beside.end()
    ? std::string(wanted) + " and " + std::string(first->name) + " exclude each other."
    : std::string();
}
}
