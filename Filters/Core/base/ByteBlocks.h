// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace neuralmesh
{
/// Bytes of items of different sizes, in blocks that threads write and read at the same time.
class ByteBlocks
{
public:
  static constexpr std::size_t ItemsOfBlock = 4096;

  /// `sizeOf(begin, end)` is what some items take, and `write(bytes, begin, end)` writes them.
  template <typename Size, typename Write>
  ByteBlocks(std::size_t count, const Executor& executor, const Size& sizeOf, const Write& write)
    : begin_((count + ItemsOfBlock - 1) / ItemsOfBlock + 1)
  {
    executor.forEachRange(count, ItemsOfBlock,
      [&](std::size_t begin, std::size_t end)
      { begin_[begin / ItemsOfBlock + 1] = sizeOf(begin, end); });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    bytes_.resize(begin_.back());
    executor.forEachRange(count, ItemsOfBlock,
      [&](std::size_t begin, std::size_t end)
      { write(bytes_.data() + begin_[begin / ItemsOfBlock], begin, end); });
  }

  /// Those of the items from `begin` on, which must be the first one of a block.
  const std::uint8_t* from(std::size_t begin) const
  {
    return bytes_.data() + begin_[begin / ItemsOfBlock];
  }

private:
  std::vector<std::size_t> begin_;
  LargeVector<std::uint8_t> bytes_;
};
}
