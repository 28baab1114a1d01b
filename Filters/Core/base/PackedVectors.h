// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"
#include "base/ZeroedArray.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace neuralmesh
{
/// The first two of four lanes.
inline double firstLanes(Vector4 v)
{
  using Halves = double __attribute__((vector_size(16)));
  return std::bit_cast<Halves>(v.lanes)[0];
}

/// Vectors in twelve bytes each, for arrays of which there are many: what is read or written is one at a time, so
/// that different ones may be used at the same time.
class PackedVectors
{
public:
  PackedVectors() = default;
  explicit PackedVectors(std::size_t count)
    : values_(3 * count)
  {
  }

  std::size_t size() const { return values_.size() / 3; }

  Vector4 operator[](std::size_t i) const { return read(values_.data() + 3 * i); }
  void set(std::size_t i, Vector4 v) { write(values_.data() + 3 * i, v); }
  void add(std::size_t i, Vector4 v) { set(i, (*this)[i] + v); }
  /// All are 0.
  void clear() { std::fill(values_.begin(), values_.end(), 0.f); }

  static Vector4 read(const float* from)
  {
    using Halves = double __attribute__((vector_size(16)));
    double first = 0.;
    std::uint32_t last = 0;
    __builtin_memcpy(&first, from, sizeof(first));
    __builtin_memcpy(&last, from + 2, sizeof(last));
    return std::bit_cast<Vector4::Lanes>(
      Halves{ first, std::bit_cast<double>(std::uint64_t(last)) });
  }
  static void write(float* to, Vector4 v)
  {
    const double first = firstLanes(v);
    __builtin_memcpy(to, &first, sizeof(first));
    to[2] = v[2];
  }

private:
  ZeroedArray<float> values_;
};
}
