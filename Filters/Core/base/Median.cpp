// SPDX-License-Identifier: BSD-3-Clause
#include "base/Median.h"

#include <bit>
#include <cstdint>

namespace neuralmesh
{
namespace
{
constexpr std::size_t BucketCount = std::size_t(1) << 15;

/// By sign, exponent and the first bits of the mantissa: floats that are not negative have the order
/// of their bits.
std::size_t bucketOf(float value) { return std::bit_cast<std::uint32_t>(value) >> 16; }
}

float medianOf(std::span<const float> values, const Executor& executor)
{
  const std::size_t parts = executor.threadCount(), count = values.size();
  std::vector<std::vector<std::uint32_t>> counts(parts);
  executor.forEachPart(parts,
    [&](std::size_t part)
    {
      std::vector<std::uint32_t> own(BucketCount, 0);
      for (std::size_t i = part * count / parts; i < (part + 1) * count / parts; ++i)
      {
        ++own[bucketOf(values[i])];
      }
      counts[part] = std::move(own);
    });
  std::size_t rank = count / 2, median = 0;
  for (;; ++median)
  {
    std::size_t inBucket = 0;
    for (const std::vector<std::uint32_t>& own : counts)
    {
      inBucket += own[median];
    }
    if (rank < inBucket)
    {
      break;
    }
    rank -= inBucket;
  }
  std::vector<float> bucket;
  std::copy_if(values.begin(), values.end(), std::back_inserter(bucket),
    [&](float value) { return bucketOf(value) == median; });
  const auto place = bucket.begin() + std::ptrdiff_t(rank);
  std::nth_element(bucket.begin(), place, bucket.end());
  return *place;
}
}
