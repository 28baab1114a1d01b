// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/TriangleSamples.h"
#include "mesh/TriangleDistances.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Some samples, four at a time, for their distances to triangles.
class SampleBundle
{
public:
  using Lanes = FourVectors::Lanes;

  void assign(const TriangleSamples& samples, std::span<const std::uint32_t> chosen)
  {
    const std::size_t groups = (chosen.size() + 3) / 4;
    points_.resize(groups);
    weights_.assign(4 * groups, 0.f);
    for (std::size_t group = 0; group < groups; ++group)
    {
      // Behind the last one, that again, without weight.
      const auto point = [&](std::size_t lane)
      { return samples.point(chosen[std::min(4 * group + lane, chosen.size() - 1)]); };
      points_[group] = FourVectors(point(0), point(1), point(2), point(3));
    }
    std::transform(chosen.begin(), chosen.end(), weights_.begin(),
      [&](std::uint32_t sample) { return samples.weight(sample); });
  }

  /// The sum of weighted squared distances to the nearest of the triangles; something above `most` if it is
  /// more than that.
  double squares(std::span<const TriangleDistances> triangles, double most) const
  {
    constexpr float Far = std::numeric_limits<float>::infinity();
    double sum = 0.;
    for (std::size_t group = 0; group < points_.size() && !(sum > most); ++group)
    {
      Lanes least{ Far, Far, Far, Far };
      for (const TriangleDistances& triangle : triangles)
      {
        const Lanes squared = triangle.squared(points_[group]);
        least = squared < least ? squared : least;
      }
      for (int lane = 0; lane < 4; ++lane)
      {
        sum += double(weights_[4 * group + std::size_t(lane)]) * double(least[lane]);
      }
    }
    return sum;
  }

  std::span<const FourVectors> points() const { return points_; }

private:
  std::vector<FourVectors> points_;
  std::vector<float> weights_;
};
}
