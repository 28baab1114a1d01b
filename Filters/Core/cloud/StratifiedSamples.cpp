// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/StratifiedSamples.h"

#include <numeric>

namespace neuralmesh
{
namespace
{
/// Places in the list for each point, on average.
constexpr std::size_t PlacesPerPoint = 2;
}

StratifiedSamples::StratifiedSamples(
  std::span<const Vector4> points, std::uint64_t seed, std::span<const float> weights)
  : points_(points)
  , seed_(seed)
  , random_(seed)
{
  if (weights.empty())
  {
    return;
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.);
  const std::size_t count = PlacesPerPoint * weights.size();
  listed_.reserve(count);
  double sum = 0.;
  std::uint32_t last = 0; // with any weight
  for (std::uint32_t point = 0; point < weights.size(); ++point)
  {
    sum += double(weights[point]);
    last = weights[point] > 0.f ? point : last;
    const double end = sum / total * double(count) - 0.5;
    while (listed_.size() < count && double(listed_.size()) < end)
    {
      listed_.push_back(point);
    }
  }
  listed_.resize(count, last);
}
}
