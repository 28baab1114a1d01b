// SPDX-License-Identifier: BSD-3-Clause
#include "SampleStream.h"

#include <bit>

namespace neuralmesh
{
std::span<const Vector4> SampleStream::draw(std::size_t count)
{
  this->drawn_.resize(count);
  this->batch_.resize(count);

  // A counting sort by the place in the cloud, which is in Morton order, with about a sample to a
  // bucket: within a bucket the order is that of drawing.
  const auto pointCount = std::uint32_t(this->points_.size());
  const std::size_t bucketCount = std::bit_ceil(count);
  this->bucketBegin_.assign(bucketCount + 1, 0);
  const auto bucketOf = [&](std::uint32_t point)
  { return std::size_t(std::uint64_t(point) * bucketCount / pointCount); };
  for (std::uint32_t& point : this->drawn_)
  {
    point = this->weighted_.isEmpty() ? this->random_.below(pointCount)
                                      : this->weighted_.draw(this->random_);
    ++this->bucketBegin_[bucketOf(point) + 1];
  }
  for (std::size_t bucket = 1; bucket <= bucketCount; ++bucket)
  {
    this->bucketBegin_[bucket] += this->bucketBegin_[bucket - 1];
  }
  for (const std::uint32_t point : this->drawn_)
  {
    this->batch_[this->bucketBegin_[bucketOf(point)]++] = this->points_[point];
  }
  return this->batch_;
}
}
