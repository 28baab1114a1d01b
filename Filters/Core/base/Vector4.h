// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace neuralmesh
{
/// A point or vector of the learning loop: x, y, z and a fourth lane that is always zero, so that
/// one register holds it. Compiled to baseline instructions of the platform, without contraction
/// to fused multiply-adds: the same bits on every machine.
struct Vector4
{
  using Lanes = float __attribute__((vector_size(16)));

  /// The compiler must not look through what has become of doubles: where it sees them read back, GCC 12.2
  /// gives them unrounded.
  static void keepRounded(Lanes& lanes)
  {
#if defined(__x86_64__)
    asm("" : "+x"(lanes));
#elif defined(__aarch64__)
    asm("" : "+w"(lanes));
#else
    asm("" : "+m"(lanes));
#endif
  }

  Lanes lanes{};

  Vector4() = default;
  Vector4(Lanes values)
    : lanes(values)
  {
  }
  Vector4(float x, float y, float z)
    : lanes{ x, y, z, 0.f }
  {
  }
  explicit Vector4(const Eigen::Vector3d& v)
    : lanes{ float(v.x()), float(v.y()), float(v.z()), 0.f }
  {
    keepRounded(lanes);
  }

  float operator[](int axis) const { return lanes[axis]; }
  Eigen::Vector3d toDouble() const
  {
    return { double(lanes[0]), double(lanes[1]), double(lanes[2]) };
  }

  Vector4& operator+=(Vector4 b) { return lanes += b.lanes, *this; }
  friend Vector4 operator+(Vector4 a, Vector4 b) { return a.lanes + b.lanes; }
  friend Vector4 operator-(Vector4 a, Vector4 b) { return a.lanes - b.lanes; }
  friend Vector4 operator*(Vector4 a, Vector4 b) { return a.lanes * b.lanes; }
  friend Vector4 operator*(float s, Vector4 a) { return s * a.lanes; }
};

inline float dot(Vector4 a, Vector4 b)
{
  const Vector4 product = a * b;
  return product[0] + product[1] + product[2];
}

inline float squaredNorm(Vector4 a) { return dot(a, a); }

/// (y, z, x, 0).
inline Vector4 rotated(Vector4 a) { return __builtin_shufflevector(a.lanes, a.lanes, 1, 2, 0, 3); }

/// The cross product before its last rotation. Sums of cross products add these up and rotate once.
inline Vector4 crossBeforeRotation(Vector4 a, Vector4 b) { return a * rotated(b) - rotated(a) * b; }

inline Vector4 cross(Vector4 a, Vector4 b) { return rotated(crossBeforeRotation(a, b)); }

inline Vector4 min(Vector4 a, Vector4 b) { return a.lanes < b.lanes ? a.lanes : b.lanes; }

inline Vector4 max(Vector4 a, Vector4 b) { return a.lanes > b.lanes ? a.lanes : b.lanes; }
}
