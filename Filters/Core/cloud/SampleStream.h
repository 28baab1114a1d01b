// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/AliasTable.h"
#include "base/Executor.h"
#include "base/Random.h"
#include "cloud/PointCloud.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The samples: points of the cloud, drawn at random with replacement, in batches: all alike, or
/// with probabilities proportional to their weights. A batch comes roughly in Morton order, so that
/// one sample finds in the cache what the one before it has used; which samples it holds depends on
/// the seed alone.
class SampleStream
{
public:
  /// `weights` are those of the points, or none.
  SampleStream(
    std::span<const Vector4> points, std::uint64_t seed, std::span<const float> weights = {})
    : points_(points)
    , random_(seed)
    , weighted_(weights)
  {
  }

  /// The next `count` samples; valid until the next call.
  std::span<const Vector4> draw(
    std::size_t count, const Executor& executor = Executor::sequential());

  /// Which samples come next; the points and their weights must be the same.
  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(random_);
  }

private:
  std::span<const Vector4> points_;
  Random random_;
  AliasTable weighted_; ///< empty if all points are drawn alike
  std::vector<std::uint32_t> drawn_;
  std::vector<std::uint32_t> sorted_;
  std::vector<std::uint32_t> bucketBegin_;
  std::vector<Vector4> batch_;
};
}
