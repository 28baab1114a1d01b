// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace neuralmesh::testing
{
/// What a fuzzer has made up, taken off byte by byte; zeros once it is used up.
class FuzzInput
{
public:
  explicit FuzzInput(std::span<const std::uint8_t> bytes)
    : bytes_(bytes)
  {
  }

  bool isEmpty() const { return this->bytes_.empty(); }
  std::span<const std::uint8_t> rest() const { return this->bytes_; }

  std::uint8_t byte()
  {
    if (this->isEmpty())
    {
      return 0;
    }
    const std::uint8_t first = this->bytes_.front();
    this->bytes_ = this->bytes_.subspan(1);
    return first;
  }
  bool flag() { return (this->byte() & 1) != 0; }
  /// Below `end`, which is 65536 at most; 0 if `end` is 0.
  std::uint32_t below(std::uint32_t end)
  {
    const std::uint32_t number = end <= 256 ? this->byte() : 256u * this->byte() + this->byte();
    return end == 0 ? 0 : number % end;
  }
  /// From `low` to `high`, both of them included; small numbers are as likely as large ones.
  double number(double low, double high)
  {
    const double fraction = double(this->below(256)) / 255.;
    return low + (high - low) * std::pow(fraction, 1. + this->below(8));
  }
  int whole(int low, int high) { return int(std::floor(this->number(low, high))); }
  /// Any number at all, NaN and infinity included.
  double anyNumber()
  {
    double result = 0.;
    const std::size_t count = std::min(sizeof(result), this->bytes_.size());
    std::memcpy(&result, this->bytes_.data(), count);
    this->bytes_ = this->bytes_.subspan(count);
    return result;
  }

private:
  std::span<const std::uint8_t> bytes_;
};
}
