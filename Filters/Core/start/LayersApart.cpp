// SPDX-License-Identifier: BSD-3-Clause
#include "start/LayersApart.h"

#include "cloud/NearestPoints.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace neuralmesh
{
namespace
{
/// So far, in radii of its samples, is a layer from another one then.
constexpr float WantedGap = 1.5f;
/// Samples around one that tell of another layer, and of how far their own one goes: within so many wanted
/// gaps, and radii.
constexpr float ReachOfGap = 1.5f;
constexpr float ReachOfMove = 2.5f;
/// Layers lie beside each other if the cosine of the angle between their normals is larger.
constexpr float LeastCosineOfLayers = 0.7f;
/// The way to another layer rises so much, against the distance, and so many errors.
constexpr float LeastRiseToLayer = 0.3f;
constexpr float ErrorsOfRiseToLayer = 3.f;
/// Of the gap: less is of the own layer.
constexpr float MostRiseInGap = 0.5f;
/// Of the samples around that know a gap: with less, one that does not know lies beyond its end.
constexpr float LeastKnown = 0.3f;

class Separation
{
public:
  explicit Separation(std::span<const LayerSample> samples)
    : samples_(samples)
    , positions_(samples.size())
    , moves_(samples.size())
  {
    std::transform(samples.begin(), samples.end(), positions_.begin(),
      [](const LayerSample& sample) { return sample.position; });
  }

  std::vector<LayerSample> run()
  {
    const NearestPoints nearest(positions_);
    for (std::uint32_t i = 0; i < samples_.size(); ++i)
    {
      findGap(i, nearest);
    }
    std::vector<LayerSample> result(samples_.begin(), samples_.end());
    for (std::uint32_t i = 0; i < samples_.size(); ++i)
    {
      result[i].position += (samples_[i].radius * meanMove(i, nearest)) * samples_[i].normal;
    }
    return result;
  }

private:
  /// By how many radii a sample is to move along its normal, and how far the next layer is.
  struct Move
  {
    float radii = 0.f;
    float gap = std::numeric_limits<float>::infinity();

    bool isKnown() const { return gap < std::numeric_limits<float>::infinity(); }
  };

  float cosine(std::uint32_t i, std::uint32_t j) const
  {
    return dot(samples_[i].normal, samples_[j].normal);
  }
  float rise(std::uint32_t i, std::uint32_t j) const
  {
    return dot(positions_[j] - positions_[i], samples_[i].normal);
  }
  bool isInOtherLayer(std::uint32_t i, std::uint32_t j, float squaredDistance) const
  {
    const float turn = std::sqrt(squaredNorm(cross(samples_[i].normal, samples_[j].normal)));
    return std::abs(rise(i, j)) > (LeastRiseToLayer + turn) * std::sqrt(squaredDistance) +
      ErrorsOfRiseToLayer * (samples_[i].error + samples_[j].error);
  }

  void findGap(std::uint32_t i, const NearestPoints& nearest)
  {
    const float wanted = WantedGap * samples_[i].radius;
    float above = wanted, below = wanted;
    nearest.forEachWithin(positions_[i], ReachOfGap * wanted,
      [&](std::uint32_t j, float squaredDistance)
      {
        if (std::abs(cosine(i, j)) >= LeastCosineOfLayers && isInOtherLayer(i, j, squaredDistance))
        {
          float& gap = rise(i, j) > 0.f ? above : below;
          gap = std::min(gap, std::abs(rise(i, j)));
        }
      });
    if (above < wanted || below < wanted)
    {
      moves_[i] = { 0.5f * (above - below) / samples_[i].radius, std::min(above, below) };
    }
  }

  /// Of its layer around it: jumps would fold it.
  float meanMove(std::uint32_t i, const NearestPoints& nearest) const
  {
    float sum = 0.f, known = 0.f, all = 0.f;
    nearest.forEachWithin(positions_[i], ReachOfMove * samples_[i].radius,
      [&](std::uint32_t j, float squaredDistance)
      {
        const float most = MostRiseInGap * std::min(moves_[i].gap, moves_[j].gap);
        if (std::abs(cosine(i, j)) >= LeastCosineOfLayers && std::abs(rise(i, j)) < most &&
          !isInOtherLayer(i, j, squaredDistance))
        {
          all += 1.f;
          known += moves_[j].isKnown() ? 1.f : 0.f;
          sum += cosine(i, j) > 0.f ? moves_[j].radii : -moves_[j].radii;
        }
      });
    return known > LeastKnown * all ? sum / known : 0.f;
  }

  std::span<const LayerSample> samples_;
  std::vector<Vector4> positions_;
  std::vector<Move> moves_;
};
}

std::vector<LayerSample> layersApart(std::span<const LayerSample> samples)
{
  return Separation(samples).run();
}
}
