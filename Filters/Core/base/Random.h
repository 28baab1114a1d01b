// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

namespace neuralmesh
{
/// Deterministic random numbers: the SplitMix64 generator (Steele, Lea, Flood 2014). Integer
/// arithmetic only, so that a seed gives the same stream on every platform. Streams of one seed
/// with different names do not overlap in practice.
class Random
{
public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
    : state_(mix(seed + Golden) ^ mix(stream * Golden + 1))
  {
  }

  std::uint64_t next()
  {
    state_ += Golden;
    return mix(state_);
  }

  /// The same stream after so many calls of next().
  Random ahead(std::uint64_t calls) const
  {
    Random later = *this;
    later.state_ += calls * Golden;
    return later;
  }

  /// Uniform in 0 ... bound - 1.
  std::uint32_t below(std::uint32_t bound) { return std::uint32_t(((next() >> 32) * bound) >> 32); }

  std::uint64_t below64(std::uint64_t bound)
  {
    __extension__ using Wide = unsigned __int128;
    return std::uint64_t(Wide(next()) * bound >> 64);
  }

  /// Uniform in [0, 1).
  double uniform() { return double(next() >> 11) * 0x1p-53; }

  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(state_);
  }

private:
  static constexpr std::uint64_t Golden = 0x9e3779b97f4a7c15u;

  static std::uint64_t mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};
}
