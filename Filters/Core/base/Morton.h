// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Vector4.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A Morton curve through a box. Points outside count as on its surface. Points that are neighbours
/// along it are neighbours in space, mostly, so that what is stored in its order is found in the cache.
class MortonCurve
{
public:
  static constexpr int BitsPerAxis = 16;
  static constexpr int KeyBits = 3 * BitsPerAxis;

  MortonCurve(Vector4 boxMin, Vector4 boxMax);

  /// Where a point lies along the curve, in KeyBits bits.
  std::uint64_t key(Vector4 point) const
  {
    const Vector4 p = scale_ * (min(max(point, boxMin_), boxMax_) - boxMin_);
    return spread(std::uint32_t(p[0])) | spread(std::uint32_t(p[1])) << 1 |
      spread(std::uint32_t(p[2])) << 2;
  }

private:
  /// Spreads the bits of a 16-bit number so that two zeros follow each.
  static std::uint64_t spread(std::uint32_t bits)
  {
    std::uint64_t x = bits;
    x = (x | x << 16) & 0x0000ff0000ffu;
    x = (x | x << 8) & 0x00f00f00f00fu;
    x = (x | x << 4) & 0x0c30c30c30c3u;
    x = (x | x << 2) & 0x249249249249u;
    return x;
  }

  Vector4 boxMin_;
  Vector4 boxMax_;
  float scale_;
};

/// The order of points along a Morton curve through a box: order[i] is the index of the i-th point.
/// O(n); points on the same spot keep their order.
std::vector<std::uint32_t> mortonOrder(std::span<const Vector4> points, Vector4 boxMin,
  Vector4 boxMax, const Executor& executor = Executor::sequential());
}
