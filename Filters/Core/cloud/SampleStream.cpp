// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/SampleStream.h"

#include <bit>

namespace neuralmesh
{
namespace
{
constexpr std::size_t DrawsPerRange = 2048;
}

std::span<const Vector4> SampleStream::draw(std::size_t count, const Executor& executor)
{
  drawn_.resize(count);
  sorted_.resize(count);
  batch_.resize(count);

  const auto pointCount = std::uint32_t(points_.size());
  const bool isWeighted = !weighted_.isEmpty();
  const std::uint64_t callsPerDraw = isWeighted ? AliasTable::CallsPerDraw : 1;
  executor.forEachRange(count, DrawsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      Random random = random_.ahead(begin * callsPerDraw);
      for (std::size_t i = begin; i < end; ++i)
      {
        drawn_[i] = isWeighted ? weighted_.draw(random) : random.below(pointCount);
      }
    });
  random_ = random_.ahead(count * callsPerDraw);

  // A counting sort by the place in the cloud, which is in Morton order, with about a sample to a
  // bucket: within a bucket the order is that of drawing.
  const std::size_t bucketCount = std::bit_ceil(count);
  bucketBegin_.assign(bucketCount + 1, 0);
  const auto bucketOf = [&](std::uint32_t point)
  { return std::size_t(std::uint64_t(point) * bucketCount / pointCount); };
  for (const std::uint32_t point : drawn_)
  {
    ++bucketBegin_[bucketOf(point) + 1];
  }
  for (std::size_t bucket = 1; bucket <= bucketCount; ++bucket)
  {
    bucketBegin_[bucket] += bucketBegin_[bucket - 1];
  }
  for (const std::uint32_t point : drawn_)
  {
    sorted_[bucketBegin_[bucketOf(point)]++] = point;
  }

  executor.forEachRange(count, DrawsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        batch_[i] = points_[sorted_[i]];
      }
    });
  return batch_;
}
}
