// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"

#include <algorithm>
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
    : ByteBlocks(count, executor, sizeOf, write, 1, [](std::size_t) {})
  {
  }
  /// The same in so many `stages`: after each, `written(end)` is told that the items before `end` are written.
  template <typename Size, typename Write, typename Written>
  ByteBlocks(std::size_t count, const Executor& executor, const Size& sizeOf, const Write& write,
    std::size_t stages, const Written& written)
    : begin_((count + ItemsOfBlock - 1) / ItemsOfBlock + 1)
  {
    executor.forEachRange(count, ItemsOfBlock,
      [&](std::size_t begin, std::size_t end)
      { begin_[begin / ItemsOfBlock + 1] = sizeOf(begin, end); });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    bytes_ = ZeroedArray<std::uint8_t>(begin_.back());
    forEachBlock(
      count, executor, stages,
      [&](std::size_t begin, std::size_t end)
      { write(bytes_.data() + begin_[begin / ItemsOfBlock], begin, end); },
      written);
  }

  /// Calls `read(bytes, begin, end)` for the items in so many stages, and frees the memory of those that are read.
  template <typename Read>
  void takeOut(std::size_t count, const Executor& executor, const Read& read, std::size_t stages)
  {
    forEachBlock(
      count, executor, stages,
      [&](std::size_t begin, std::size_t end) { read(from(begin), begin, end); },
      [&](std::size_t end) { bytes_.releaseFirst(begin_[end / ItemsOfBlock]); });
  }

  /// Those of the items from `begin` on, which must be the first one of a block.
  const std::uint8_t* from(std::size_t begin) const
  {
    return bytes_.data() + begin_[begin / ItemsOfBlock];
  }

private:
  /// Calls `use(begin, end)` for the items of each block, and after each stage `isUsed(end)`.
  template <typename Use, typename Used>
  static void forEachBlock(std::size_t count, const Executor& executor, std::size_t stages,
    const Use& use, const Used& isUsed)
  {
    const std::size_t items = (count / (stages * ItemsOfBlock) + 1) * ItemsOfBlock;
    for (std::size_t first = 0; first < count; first += items)
    {
      const std::size_t last = std::min(count, first + items);
      executor.forEachRange(last - first, ItemsOfBlock,
        [&](std::size_t begin, std::size_t end) { use(first + begin, first + end); });
      isUsed(last);
    }
  }

  std::vector<std::size_t> begin_;
  ZeroedArray<std::uint8_t> bytes_;
};
}
