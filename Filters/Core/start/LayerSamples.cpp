// SPDX-License-Identifier: BSD-3-Clause
#include "start/LayerSamples.h"

#include "base/Median.h"
#include "base/Morton.h"
#include "base/Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>

namespace neuralmesh
{
namespace
{
/// Samples that are so much farther apart than usual are scattered in space, if on average over so many of them
/// less than a part of those around lie in one layer with them: by chance hardly two do.
constexpr float SparseAgainstUsual = 2.f;
constexpr std::size_t SparseAsked = 32;
constexpr std::size_t AroundSparse = 8;
constexpr float LeastPartInLayer = 0.4f;
/// Of those that are sparse, or of all: fewer are what ends of a scan have, and stay.
constexpr double MostSparseScattered = 0.5;
constexpr double MostScatteredOfLayers = 0.015;
/// And points that are so much farther apart, and scatter so much more: sparse parts of a surface are as noisy as
/// others, about.
constexpr float VerySparseAgainstUsual = 3.f;
constexpr float NoisyAgainstUsual = 4.f;
constexpr float NoisyAgainstRadius = 0.11f;
/// Samples that came that close to each other when they were moved.
constexpr float ClosestOfMoved = 0.4f;
/// The layer of a sample goes up so much at most, against the distance, and is so thick against the noise.
constexpr float SlopeOfDisk = 0.25f;
constexpr float NoiseOfDisk = 3.f;

/// Of one layer: cosine of the angle between normals, rise over the distance, and how many radii are looked
/// at, for as many samples at least.
constexpr float LeastCosineInLayer = 0.7f;
constexpr float LargestRiseInLayer = 0.3f;
constexpr float ReachOfLayer = 1.5f;
constexpr std::size_t LeastAroundStray = 4;
/// At a corner, the directions to those within so many radii have a mean of that length: 0.90 at the tip of a right
/// angle, 0.64 at a straight edge, less between two layers. There are so many, for which such an angle has room.
constexpr float ReachOfCorner = 4.f;
constexpr float LeastMeanAtCorner = 0.75f;
constexpr float LeastAroundCorner = 8.f;

constexpr std::uint32_t NoSample = ~0u;
constexpr std::size_t LayersPerCheck = 256;
/// Of so many one is asked whether there are two layers.
constexpr std::size_t SamplesPerProbe = 16;
/// Of those tried so far: where so many lie in no layer, the noise is wider than samples are apart.
constexpr double MostInNoLayer = 0.25;
/// It is sure that there are more than are allowed beyond so many deviations of chance.
constexpr double DeviationsOfSure = 4.;

/// The numbers below `count`, shuffled.
std::vector<std::uint32_t> shuffled(std::size_t count, std::uint64_t seed)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  Random random(seed);
  for (std::size_t i = count; i > 1; --i)
  {
    std::swap(order[i - 1], order[random.below(std::uint32_t(i))]);
  }
  return order;
}

/// Whether a place within the radius of a sample lies in its layer, not in another one beside it.
bool isOnDisk(const LayerSample& sample, Vector4 place)
{
  const Vector4 offset = place - sample.position;
  const float height = std::abs(dot(offset, sample.normal));
  return height <= NoiseOfDisk * sample.noise ||
    height * height <= SlopeOfDisk * SlopeOfDisk * squaredNorm(offset);
}

std::vector<Vector4> positionsOf(std::span<const LayerSample> samples)
{
  std::vector<Vector4> positions(samples.size());
  std::transform(samples.begin(), samples.end(), positions.begin(),
    [](const LayerSample& sample) { return sample.position; });
  return positions;
}

/// In an order in which those that are near in space are mostly near each other.
std::vector<LayerSample> sorted(std::span<const LayerSample> samples)
{
  const std::vector<Vector4> positions = positionsOf(samples);
  Box box;
  std::for_each(
    positions.begin(), positions.end(), [&](Vector4 position) { box.extend(position); });
  std::vector<LayerSample> result;
  result.reserve(samples.size());
  for (const std::uint32_t i : mortonOrder(positions, box.low, box.high))
  {
    result.push_back(samples[i]);
  }
  return result;
}

/// Without those that came too close to others when they were moved.
std::vector<LayerSample> apart(
  std::span<const LayerSample> samples, Layers layers, std::uint64_t seed)
{
  const std::vector<Vector4> positions = positionsOf(samples);
  const NearestPoints nearest(positions);
  std::vector<bool> isCovered(samples.size(), false);
  std::vector<std::uint32_t> kept;
  for (const std::uint32_t i : shuffled(samples.size(), seed))
  {
    if (isCovered[i])
    {
      continue;
    }
    kept.push_back(i);
    nearest.forEachWithin(positions[i], ClosestOfMoved * samples[i].radius,
      [&](std::uint32_t other, float)
      {
        if (layers == Layers::Joined || isOnDisk(samples[i], positions[other]))
        {
          isCovered[other] = true;
        }
      });
  }
  std::sort(kept.begin(), kept.end());
  std::vector<LayerSample> result;
  result.reserve(kept.size());
  for (const std::uint32_t i : kept)
  {
    result.push_back(samples[i]);
  }
  return result;
}

/// Whether the way from a sample to another one rises above its plane no more than their planes differ.
bool areInOneLayer(const LayerSample& sample, const LayerSample& other)
{
  const Vector4 way = other.position - sample.position;
  const float rise = std::abs(dot(way, sample.normal));
  const float cosine = std::abs(dot(sample.normal, other.normal));
  return cosine >= LeastCosineInLayer &&
    rise * rise <= LargestRiseInLayer * LargestRiseInLayer * squaredNorm(way);
}

/// Whether all those around a place that are no strays lie to one side of it, within less than a half turn.
bool isAtCorner(
  const NearestPoints& nearest, Vector4 place, float reach, const std::vector<bool>& isStray)
{
  Vector4 sum{};
  float count = 0.f;
  nearest.forEachWithin(place, reach,
    [&](std::uint32_t other, float)
    {
      const Vector4 way = nearest.points()[other] - place;
      const float squaredLength = squaredNorm(way);
      if (!isStray[other] && squaredLength > 0.f)
      {
        sum += (1.f / std::sqrt(squaredLength)) * way;
        count += 1.f;
      }
    });
  return count >= LeastAroundCorner &&
    squaredNorm(sum) >= LeastMeanAtCorner * LeastMeanAtCorner * count * count;
}

/// Without those that lie in one layer with none around them: between two layers, or across them. At the corner of a
/// thin plate with noise that is true of all, and it would be cut off: they stay.
std::vector<LayerSample> withoutStrays(std::vector<LayerSample> samples)
{
  const std::vector<Vector4> positions = positionsOf(samples);
  const NearestPoints nearest(positions);
  std::vector<bool> isStray(samples.size(), false);
  for (std::uint32_t i = 0; i < samples.size(); ++i)
  {
    std::size_t around = 0, inLayer = 0;
    nearest.forEachWithin(positions[i], ReachOfLayer * samples[i].radius,
      [&](std::uint32_t other, float)
      {
        around += other != i ? 1 : 0;
        inLayer += other != i && areInOneLayer(samples[i], samples[other]) ? 1 : 0;
      });
    isStray[i] = inLayer == 0 && around >= LeastAroundStray;
  }
  std::size_t i = 0;
  std::erase_if(samples,
    [&](const LayerSample& sample)
    {
      const bool isErased =
        isStray[i] && !isAtCorner(nearest, positions[i], ReachOfCorner * sample.radius, isStray);
      ++i;
      return isErased;
    });
  return samples;
}

/// The part of those around a sample that may lie in one layer with it.
float partInLayer(
  std::span<const LayerSample> samples, const NearestPoints& nearest, std::uint32_t sample)
{
  const auto mayBeInOneLayer = [](const LayerSample& a, const LayerSample& b)
  {
    // Lines of a scanner tell no layer.
    return squaredNorm(a.normal) == 0.f || squaredNorm(b.normal) == 0.f ||
      (areInOneLayer(a, b) && areInOneLayer(b, a));
  };
  std::array<NearPoint, AroundSparse + 1> found;
  const std::size_t count = nearest.find(samples[sample].position, found);
  float around = 0.f, inLayer = 0.f;
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint32_t other = found[i].index;
    around += other != sample ? 1.f : 0.f;
    inLayer += other != sample && mayBeInOneLayer(samples[sample], samples[other]) ? 1.f : 0.f;
  }
  return inLayer / std::max(around, 1.f);
}

/// Which are farther apart than `radius`, where those that are so lie in one layer with hardly any. None if they
/// are few.
std::vector<bool> findScattered(std::span<const LayerSample> samples, float radius)
{
  const std::vector<Vector4> positions = positionsOf(samples);
  const NearestPoints nearest(positions);
  std::vector<std::uint32_t> sparse;
  std::vector<Vector4> places;
  std::vector<float> parts;
  for (std::uint32_t i = 0; i < samples.size(); ++i)
  {
    if (samples[i].radius > radius)
    {
      sparse.push_back(i);
      places.push_back(positions[i]);
      parts.push_back(partInLayer(samples, nearest, i));
    }
  }
  const NearestPoints nearestSparse(places);
  std::array<NearPoint, SparseAsked> found;
  std::vector<bool> result(samples.size(), false);
  for (std::size_t i = 0; i < sparse.size(); ++i)
  {
    const std::size_t count = nearestSparse.find(places[i], found);
    float sum = 0.f;
    for (std::size_t k = 0; k < count; ++k)
    {
      sum += parts[found[k].index];
    }
    result[sparse[i]] = sum < LeastPartInLayer * float(count);
  }
  const auto scattered = double(std::count(result.begin(), result.end(), true));
  return scattered > std::min(MostSparseScattered * double(sparse.size()),
                       MostScatteredOfLayers * double(samples.size()))
    ? result
    : std::vector<bool>(samples.size(), false);
}

/// Without those of points that are scattered in space.
std::vector<LayerSample> withoutScattered(std::vector<LayerSample> samples)
{
  if (samples.empty())
  {
    return samples;
  }
  std::vector<float> radii, noises;
  for (const LayerSample& sample : samples)
  {
    radii.push_back(sample.radius);
    noises.push_back(sample.noise);
  }
  const float radius = medianOf(std::move(radii)), noise = medianOf(std::move(noises));
  const auto isNoisy = [&](const LayerSample& sample)
  {
    return sample.radius > VerySparseAgainstUsual * radius &&
      sample.noise > NoisyAgainstUsual * noise && sample.noise > NoisyAgainstRadius * sample.radius;
  };
  const std::vector<bool> isScattered = findScattered(samples, SparseAgainstUsual * radius);
  std::size_t i = 0;
  std::erase_if(samples,
    [&](const LayerSample& sample)
    {
      const bool isErased = isScattered[i] || isNoisy(sample);
      ++i;
      return isErased;
    });
  return samples;
}

/// Whether too many of those tried lie in no layer.
bool areTooMany(std::size_t inNoLayer, std::size_t tried, double most)
{
  const double allowed = most * double(tried);
  return double(inNoLayer) >
    std::min(MostInNoLayer * double(tried), allowed + DeviationsOfSure * std::sqrt(allowed));
}
}

LayerSamples layerSamples(PointLayers& pointLayers, Layers layers, std::uint64_t seed,
  const Progress& progress, double mostInNoLayer)
{
  const NearestPoints& nearest = pointLayers.nearest();
  const std::span<const Vector4> points = nearest.points();
  std::vector<bool> isCovered(points.size(), false);
  // Of each point, the last sample in whose reach it is.
  std::vector<std::uint32_t> reachedBy(points.size(), NoSample);
  std::vector<LayerSample> samples;
  std::size_t inNoLayer = 0, asked = 0, inOneOfTwo = 0;
  for (const std::uint32_t point : shuffled(points.size(), seed))
  {
    if (isCovered[point])
    {
      continue;
    }
    const std::size_t tried = samples.size() + inNoLayer;
    if (tried > 0 && tried % LayersPerCheck == 0 &&
      (areTooMany(inNoLayer, tried, mostInNoLayer) ||
        !progress(std::min(1., double(samples.size()) / double(pointLayers.count())))))
    {
      return {};
    }
    if (layers == Layers::Joined && tried % SamplesPerProbe == 0)
    {
      ++asked;
      inOneOfTwo += pointLayers.isInOneOfTwo(point) ? 1 : 0;
    }
    const PointLayers::Told told = pointLayers.at(point, layers);
    const LayerSample& sample = told.sample;
    // Noise had it look as if it were in another layer than what is there.
    if (told.isInLayer && reachedBy[point] != NoSample &&
      isOnDisk(samples[reachedBy[point]], sample.position))
    {
      continue;
    }
    const bool coversAll = layers == Layers::Joined || !told.isInLayer;
    nearest.forEachWithin(points[point], sample.radius,
      [&](std::uint32_t other, float)
      {
        if (coversAll || isOnDisk(sample, points[other]))
        {
          isCovered[other] = true;
        }
        else
        {
          reachedBy[other] = std::uint32_t(samples.size());
        }
      });
    if (told.isInLayer)
    {
      samples.push_back(sample);
    }
    else
    {
      ++inNoLayer;
    }
  }
  samples = apart(sorted(withoutScattered(sorted(samples))), layers, seed);
  return { layers == Layers::Apart ? withoutStrays(std::move(samples)) : std::move(samples),
    inNoLayer, double(inOneOfTwo) / double(std::max<std::size_t>(1, asked)) };
}
}
