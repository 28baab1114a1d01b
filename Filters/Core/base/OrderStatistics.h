// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Finds the value that has the place `rank` (from 0 on) among numbers once they are sorted. They are
/// not copied, but gone over: as long as the value is not found, all of them are to be added anew, in
/// any order. With a bracket that holds it and few others that is once, else some three times. None may
/// be NaN, and there must be more than `rank`.
///
///     while (!search.isFound())
///     {
///       for (const double number : numbers) search.add(number);
///       search.endSweep();
///     }
class OrderStatisticSearch
{
public:
  /// Where the value is supposed to be. It is found, too, if it is not there, or if more than `most`
  /// numbers are, which is how many are copied at most.
  struct Bracket
  {
    double low = 0.;
    double high = 0.;
    std::size_t most = 0;
  };

  OrderStatisticSearch(std::size_t rank, const Bracket& bracket)
    : rank_(rank)
    , bracket_(bracket)
  {
    taken_.reserve(bracket.most);
  }

  void add(double number)
  {
    if (isBracketed_)
    {
      below_ += number < bracket_.low ? 1 : 0;
      if (number >= bracket_.low && number <= bracket_.high && taken_.size() < bracket_.most)
      {
        taken_.push_back(number);
      }
      return;
    }
    // What begins with the bits that are known.
    const std::uint64_t offset = keyOf(number) - low_;
    if (offset >> shift_ < Bins)
    {
      ++counts_[offset >> shift_];
    }
  }

  void endSweep()
  {
    if (isFound_)
    {
      return;
    }
    if (isBracketed_)
    {
      endBracket();
      return;
    }
    std::uint64_t bin = 0;
    for (; rank_ >= counts_[bin]; ++bin)
    {
      rank_ -= counts_[bin];
    }
    low_ += bin << shift_;
    isFound_ = shift_ == 0;
    value_ = numberOf(low_);
    shift_ = shift_ >= BinBits ? shift_ - BinBits : 0;
    std::fill(counts_.begin(), counts_.end(), 0);
  }

  bool isFound() const { return isFound_; }
  double value() const { return value_; }

private:
  static constexpr int BinBits = 16;
  static constexpr std::uint64_t Bins = std::uint64_t(1) << BinBits;
  static constexpr std::uint64_t Sign = std::uint64_t(1) << 63;

  /// Whole numbers in the order of the numbers: the bits, of those below zero reversed.
  static std::uint64_t keyOf(double number)
  {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    return bits & Sign ? ~bits : bits | Sign;
  }
  static double numberOf(std::uint64_t key)
  {
    return std::bit_cast<double>(key & Sign ? key & ~Sign : ~key);
  }

  void endBracket()
  {
    if (taken_.size() < bracket_.most && rank_ >= below_ && rank_ - below_ < taken_.size())
    {
      const auto place = taken_.begin() + std::ptrdiff_t(rank_ - below_);
      std::nth_element(taken_.begin(), place, taken_.end());
      value_ = *place;
      isFound_ = true;
      bracket_.most = 0; // whatever is added now
    }
    else
    {
      isBracketed_ = false;
      counts_.assign(Bins, 0);
    }
    std::vector<double>().swap(taken_);
  }

  std::size_t rank_; ///< among the numbers in the bins
  Bracket bracket_;
  bool isBracketed_ = true;
  std::size_t below_ = 0;
  std::vector<double> taken_;
  std::uint64_t low_ = 0; ///< the key of the first bin
  int shift_ = 64 - BinBits;
  std::vector<std::uint32_t> counts_;
  bool isFound_ = false;
  double value_ = 0.;
};
}
