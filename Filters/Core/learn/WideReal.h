// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>

namespace neuralmesh
{
/// A positive real, or zero, with the precision of a double and an exponent without end:
/// significand times 2 to the power of epoch * 512. Sums keep the epoch of the larger number, so
/// that a series of growing numbers is never rescaled and the smallest of them never vanish.
/// Numbers are ordered rightly as long as their significands lie in [2^-250, 2^250] times a power
/// of two that they share.
struct WideReal
{
  static constexpr int EpochBits = 512;

  double significand = 0.;
  std::int32_t epoch = 0;

  /// This number in another epoch; zero, or infinity, where that is out of a double's range.
  double in(std::int32_t otherEpoch) const
  {
    const std::int64_t distance = std::int64_t(epoch) - otherEpoch;
    if (distance == 0) [[likely]]
    {
      return significand;
    }
    const std::int64_t bits = distance * EpochBits;
    return std::ldexp(significand, int(bits < -4096 ? -4096 : bits > 4096 ? 4096 : bits));
  }

  friend std::strong_ordering operator<=>(const WideReal& a, const WideReal& b)
  {
    const double left = a.significand;
    const double right = a.epoch == b.epoch ? b.significand : b.in(a.epoch);
    return left < right ? std::strong_ordering::less
      : left > right    ? std::strong_ordering::greater
                        : std::strong_ordering::equal;
  }
  friend bool operator==(const WideReal& a, const WideReal& b) { return (a <=> b) == 0; }

  /// This number plus one that is not of an earlier epoch.
  WideReal plus(const WideReal& later) const
  {
    // Adding nothing must not take this number into an epoch in which it vanishes.
    if (later.significand == 0.)
    {
      return *this;
    }
    return { in(later.epoch) + later.significand, later.epoch };
  }

  WideReal times(double factor) const { return { significand * factor, epoch }; }

  /// Moves what the significand has grown by into the epoch once it is large.
  void carry()
  {
    if (significand >= 0x1p256)
    {
      significand *= 0x1p-512;
      ++epoch;
    }
  }
};
}
