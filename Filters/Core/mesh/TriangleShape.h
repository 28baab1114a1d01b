// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
/// Area of an equilateral triangle over the square of its edge.
inline const float EquilateralArea = std::sqrt(3.f) / 4.f;

inline float triangleArea(Vector4 a, Vector4 b, Vector4 c)
{
  return 0.5f * std::sqrt(squaredNorm(cross(b - a, c - a)));
}

inline float squaredLongestEdge(Vector4 a, Vector4 b, Vector4 c)
{
  return std::max({ squaredNorm(b - a), squaredNorm(c - b), squaredNorm(a - c) });
}

/// How far a triangle is from equilateral: 0 for an equilateral one, up to 1.
inline float inequality(Vector4 a, Vector4 b, Vector4 c)
{
  const float edges = squaredNorm(b - a) + squaredNorm(c - b) + squaredNorm(a - c);
  return edges > 0.f ? 1.f - 16.f * EquilateralArea * triangleArea(a, b, c) / edges : 1.f;
}
}
