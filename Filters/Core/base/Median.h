// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The median of values, of an even number the upper one; there must be one.
template <typename Value>
Value medianOf(std::vector<Value> values)
{
  const auto median = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), median, values.end());
  return *median;
}

/// The same of many values, none of which is below 0 or NaN.
float medianOf(std::span<const float> values, const Executor& executor);
}
