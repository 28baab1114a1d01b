// SPDX-License-Identifier: BSD-3-Clause
// Requests that exclude each other.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// Another request of a run.
struct AskedBeside
{
  bool isThere;
  std::string_view name;
};

/// The sentence that `wanted` and the first request in use exclude each other; empty if none is in
/// use.
inline std::string whyExcluded(std::string_view wanted, std::initializer_list<AskedBeside> beside)
{
  const auto* const first = std::ranges::find_if(beside, &AskedBeside::isThere);
  return first != beside.end()
    ? std::string(wanted) + " and " + std::string(first->name) + " exclude each other."
    : std::string();
}
}
