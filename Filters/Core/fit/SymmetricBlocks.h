// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/PackedVectors.h"
#include "base/Vector4.h"
#include "base/ZeroedArray.h"

#include <Eigen/LU>

#include <cstddef>

namespace neuralmesh
{
/// A symmetric 3 x 3 matrix.
struct SymmetricBlock
{
  Vector4 diagonal; ///< xx, yy, zz
  Vector4 others;   ///< xy, yz, zx

  SymmetricBlock& operator+=(const SymmetricBlock& b)
  {
    diagonal += b.diagonal;
    others += b.others;
    return *this;
  }
  SymmetricBlock inverse() const
  {
    const Eigen::Vector3d d = diagonal.toDouble(), o = others.toDouble();
    Eigen::Matrix3d matrix;
    matrix << d.x(), o.x(), o.z(), o.x(), d.y(), o.y(), o.z(), o.y(), d.z();
    const Eigen::Matrix3d inverse = matrix.inverse();
    return { Vector4(Eigen::Vector3d(inverse.diagonal())),
      Vector4(Eigen::Vector3d(inverse(0, 1), inverse(1, 2), inverse(2, 0))) };
  }
  friend SymmetricBlock operator*(float s, const SymmetricBlock& b)
  {
    return { s * b.diagonal, s * b.others };
  }
  friend Vector4 operator*(const SymmetricBlock& b, Vector4 x)
  {
    return b.diagonal * x + b.others * rotated(x) + rotated(rotated(b.others * x));
  }
};

/// An array of such matrices with 24 bytes each. Threads may use different elements at the same
/// time.
class SymmetricBlocks
{
public:
  explicit SymmetricBlocks(std::size_t count)
    : values_(BlockSize * count)
  {
  }

  std::size_t size() const { return values_.size() / BlockSize; }

  SymmetricBlock operator[](std::size_t i) const
  {
    const float* const from = values_.data() + BlockSize * i;
    return { PackedVectors::read(from), PackedVectors::read(from + 3) };
  }
  void set(std::size_t i, const SymmetricBlock& block)
  {
    float* const to = values_.data() + BlockSize * i;
    PackedVectors::write(to, block.diagonal);
    PackedVectors::write(to + 3, block.others);
  }
  void add(std::size_t i, const SymmetricBlock& block)
  {
    SymmetricBlock sum = (*this)[i];
    set(i, sum += block);
  }

private:
  static constexpr std::size_t BlockSize = 6;

  ZeroedArray<float> values_;
};
}
