// SPDX-License-Identifier: BSD-3-Clause
#include "base/AliasTable.h"

#include <algorithm>
#include <numeric>

namespace neuralmesh
{
AliasTable::AliasTable(std::span<const float> weights)
{
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
  std::vector<double> left; // of each index, in shares of an entry
  std::vector<std::uint32_t> poor, rich;
  entries_.reserve(weights.size());
  left.reserve(weights.size());
  for (const float weight : weights)
  {
    const auto index = std::uint32_t(left.size());
    left.push_back(double(weight) * double(weights.size()) / sum);
    (left.back() < 1. ? poor : rich).push_back(index);
    entries_.push_back({ 1.f, index });
  }
  while (!poor.empty() && !rich.empty())
  {
    const std::uint32_t filled = poor.back(), giver = rich.back();
    poor.pop_back();
    entries_[filled] = { float(left[filled]), giver };
    left[giver] -= 1. - left[filled];
    if (left[giver] < 1.)
    {
      rich.pop_back();
      poor.push_back(giver);
    }
  }
  // What rounding leaves without a partner.
  const auto heaviest =
    std::uint32_t(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (const std::uint32_t index : poor)
  {
    entries_[index] = { float(left[index]), heaviest };
  }
}
}
