// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <cmath>

namespace neuralmesh
{
/// One long, or zero.
inline Vector4 unit(Vector4 a)
{
  const float squared = squaredNorm(a);
  return squared > 0.f ? 1.f / std::sqrt(squared) * a : Vector4();
}
}
