// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
/// Items by the bucket that they fall into; those of the same bucket keep their order. 4 bytes an item.
class BucketOrder
{
public:
  /// Of `count` items, or some of them: `forEach(begin, end, use)` calls `use(item, bucket)` for those in
  /// a range, in their order, and is called twice for each range of `grain` items.
  template <typename ForEach>
  BucketOrder(std::size_t count, std::size_t grain, std::size_t bucketCount, const ForEach& forEach,
    const Executor& executor)
    : ends_(bucketCount)
  {
    // Where the items of each bucket in each range go.
    const std::size_t ranges = (count + grain - 1) / grain;
    std::vector<std::uint32_t> places(ranges * bucketCount);
    executor.forEachRange(count, grain,
      [&](std::size_t begin, std::size_t end)
      {
        std::uint32_t* const counts = &places[begin / grain * bucketCount];
        forEach(begin, end, [&](std::size_t, std::size_t bucket) { ++counts[bucket]; });
      });
    std::uint32_t next = 0;
    for (std::size_t bucket = 0; bucket < bucketCount; ++bucket)
    {
      for (std::size_t range = 0; range < ranges; ++range)
      {
        next += std::exchange(places[range * bucketCount + bucket], next);
      }
      ends_[bucket] = next;
    }
    items_ = std::make_unique_for_overwrite<std::uint32_t[]>(next);
    executor.forEachRange(count, grain,
      [&](std::size_t begin, std::size_t end)
      {
        std::uint32_t* const place = &places[begin / grain * bucketCount];
        forEach(begin, end,
          [&](std::size_t item, std::size_t bucket)
          { items_[place[bucket]++] = std::uint32_t(item); });
      });
  }

  /// Of all buckets.
  std::size_t itemCount() const { return ends_.empty() ? 0 : ends_.back(); }
  std::size_t bucketCount() const { return ends_.size(); }
  /// Items in the buckets before.
  std::size_t begin(std::size_t bucket) const { return bucket > 0 ? ends_[bucket - 1] : 0; }
  std::span<const std::uint32_t> items(std::size_t bucket) const
  {
    return { &items_[begin(bucket)], ends_[bucket] - begin(bucket) };
  }

private:
  std::vector<std::uint32_t> ends_;
  std::unique_ptr<std::uint32_t[]> items_;
};
}
