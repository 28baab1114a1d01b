// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

namespace neuralmesh
{
/// Four vectors at once, coordinate by coordinate. What is computed of each has the bits that Vector4
/// gives.
struct FourVectors
{
  using Lanes = Vector4::Lanes;
  /// For each lane all bits, or none.
  using Mask = int __attribute__((vector_size(16)));

  Lanes x{}, y{}, z{};

  FourVectors() = default;
  FourVectors(Lanes ofX, Lanes ofY, Lanes ofZ)
    : x(ofX)
    , y(ofY)
    , z(ofZ)
  {
  }
  /// One vector, four times.
  explicit FourVectors(Vector4 v)
    : x(__builtin_shufflevector(v.lanes, v.lanes, 0, 0, 0, 0))
    , y(__builtin_shufflevector(v.lanes, v.lanes, 1, 1, 1, 1))
    , z(__builtin_shufflevector(v.lanes, v.lanes, 2, 2, 2, 2))
  {
  }
  FourVectors(Vector4 a, Vector4 b, Vector4 c, Vector4 d)
  {
    const Lanes ab = __builtin_shufflevector(a.lanes, b.lanes, 0, 4, 1, 5);
    const Lanes cd = __builtin_shufflevector(c.lanes, d.lanes, 0, 4, 1, 5);
    x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
    y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
    const Lanes zOfAB = __builtin_shufflevector(a.lanes, b.lanes, 2, 6, 2, 6);
    const Lanes zOfCD = __builtin_shufflevector(c.lanes, d.lanes, 2, 6, 2, 6);
    z = __builtin_shufflevector(zOfAB, zOfCD, 0, 1, 4, 5);
  }

  friend FourVectors operator-(const FourVectors& a, const FourVectors& b)
  {
    return { a.x - b.x, a.y - b.y, a.z - b.z };
  }
  friend FourVectors operator*(Lanes s, const FourVectors& a)
  {
    return { s * a.x, s * a.y, s * a.z };
  }
};

inline FourVectors::Lanes dot(const FourVectors& a, const FourVectors& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline FourVectors::Lanes squaredNorm(const FourVectors& a) { return dot(a, a); }

inline FourVectors cross(const FourVectors& a, const FourVectors& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/// Each number, but at least 0 and at most 1.
inline FourVectors::Lanes clampedToOne(FourVectors::Lanes values)
{
  constexpr FourVectors::Lanes zero{}, one{ 1.f, 1.f, 1.f, 1.f };
  const FourVectors::Lanes most = one < values ? one : values;
  return values < zero ? zero : most;
}
}
