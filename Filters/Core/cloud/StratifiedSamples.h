// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "cloud/PointCloud.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Samples of a cloud, drawn in batches that cover it evenly: of as many samples as there are to be, each
/// comes from its own stretch of the points, at random. As points are in Morton order, so is a batch, and
/// each sample may be drawn by itself, on any thread.
class StratifiedSamples
{
public:
  /// All points alike, or in proportion to `weights`, one for each of them, if there are any.
  StratifiedSamples(
    std::span<const Vector4> points, std::uint64_t seed, std::span<const float> weights = {});

  void beginBatch(std::size_t count)
  {
    count_ = count;
    random_ = Random(seed_, FirstStream + batch_++);
  }
  /// The samples from `begin` on, by a stream of random numbers that draw() takes on.
  Random from(std::size_t begin) const { return random_.ahead(begin); }
  Vector4 draw(std::size_t sample, Random& random) const
  {
    const std::size_t places = listed_.empty() ? points_.size() : listed_.size();
    const double place = (double(sample) + random.uniform()) / double(count_) * double(places);
    const std::size_t at = std::min(std::size_t(place), places - 1);
    return points_[listed_.empty() ? at : listed_[at]];
  }

  /// Which batch comes next; the points and their weights must be the same.
  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(batch_);
  }

private:
  /// No other random numbers of the seed are named so.
  static constexpr std::uint64_t FirstStream = std::uint64_t(1) << 32;

  std::span<const Vector4> points_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> listed_; ///< points, each as often as its weight says; none: all alike
  std::uint64_t batch_ = 0;
  std::size_t count_ = 0;
  Random random_;
};
}
