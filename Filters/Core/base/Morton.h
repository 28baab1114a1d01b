// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Vector4.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The order of points along a Morton curve through a box (points outside count as on its surface):
/// order[i] is the index of the i-th point. Points that are neighbours in it are neighbours in
/// space, mostly, so that what is stored in this order is found in the cache. O(n); points on the
/// same spot keep their order.
std::vector<std::uint32_t> mortonOrder(std::span<const Vector4> points, Vector4 boxMin,
  Vector4 boxMax, const Executor& executor = Executor::sequential());
}
