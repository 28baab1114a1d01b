// SPDX-License-Identifier: BSD-3-Clause
#include "start/PointLayers.h"

#include "base/Median.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Points that tell how the distance between points is distributed.
constexpr std::size_t SurveyPoints = 2000;
/// Of the distance to the last neighbour, at least, is the radius: a sample stands for more points
/// than itself where there are so few.
constexpr float LeastRadius = 0.5f;
/// Samples for each disk of the radius that points fill, as chance packs them.
constexpr double Packing = 0.41;

/// Of the gap to the layer beside it is the radius at most ...
constexpr float PartOfGapBeside = 0.65f;
/// ... unless it were less than so much of what it is else, or so many distances between points: layers that are closer
/// are no matter of the radius.
constexpr float LeastPartOfRadius = 0.5f;
constexpr float LeastSpacingsOfRadius = 1.5f;
/// A point is of the layer beside if the way to it rises so much against its length ...
constexpr float RiseToLayerBeside = 0.8f;
/// ... and more than so many deviations of the points across the layer.
constexpr float NoisesToLayerBeside = 12.f;
/// Of the angle between the normals of both.
constexpr float CosineOfLayerBeside = 0.7f;

constexpr std::uint32_t NoPlace = ~0u;
}

PointLayers::PointLayers(const NearestPoints& nearest, std::size_t count)
  : search_(nearest)
  , count_(count)
  , numbers_(nearest.points().size(), NoPlace)
{
  const std::size_t points = nearest.points().size();
  const std::size_t asked = std::min(points, SurveyPoints);
  std::vector<Spacing> survey(asked);
  std::vector<float> means(asked);
  for (std::size_t i = 0; i < asked; ++i)
  {
    survey[i] = spacingAt(nearest, std::uint32_t(i * points / asked));
    means[i] = survey[i].mean;
  }
  usualSpacing_ = std::max(medianOf(std::move(means)), std::numeric_limits<float>::min());
  // Bisection: the number falls with the factor.
  double low = 1e-6, high = 1e6;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = std::sqrt(low * high);
    factor_ = float(middle) * usualSpacing_;
    double disks = 0.;
    for (const Spacing& spacing : survey)
    {
      const double part = double(spacing.mean) / std::max(double(radius(spacing)), 1e-30);
      disks += std::min(1., Packing * part * part);
    }
    (disks * double(points) / double(asked) > double(count) ? low : high) = middle;
  }
}

float PointLayers::radius(const Spacing& spacing) const
{
  return std::max(
    factor_ * std::sqrt(spacing.mean / usualSpacing_), LeastRadius * spacing.farthest);
}

PointLayers::Known& PointLayers::known(std::uint32_t point)
{
  std::uint32_t& number = numbers_[point];
  if (number == NoPlace)
  {
    number = std::uint32_t(known_.size());
    Known& added = known_.emplace_back();
    added.spacing = spacingAt(nearest(), point);
    added.joined.sample.position = nearest().points()[point];
    added.joined.sample.radius = radius(added.spacing);
  }
  return known_[number];
}

PointLayers::Told PointLayers::at(std::uint32_t point, Layers layers)
{
  Told result = told(point, layers);
  LayerSample& sample = result.sample;
  const float least =
    std::max(LeastPartOfRadius * sample.radius, LeastSpacingsOfRadius * known(point).spacing.mean);
  if (result.isInLayer && !result.isOneOfTwo && least < sample.radius)
  {
    const float wanted = PartOfGapBeside * gapBeside(sample, layers);
    sample.radius = wanted >= least ? std::min(sample.radius, wanted) : sample.radius;
  }
  return result;
}

float PointLayers::gapBeside(const LayerSample& sample, Layers layers)
{
  float gap = std::numeric_limits<float>::infinity();
  std::uint32_t beside = NoPlace;
  nearest().forEachWithin(sample.position, sample.radius / PartOfGapBeside,
    [&](std::uint32_t other, float squaredDistance)
    {
      const float rise = std::abs(dot(nearest().points()[other] - sample.position, sample.normal));
      if (rise < gap && rise > NoisesToLayerBeside * sample.noise &&
        rise * rise > RiseToLayerBeside * RiseToLayerBeside * squaredDistance)
      {
        gap = rise;
        beside = other;
      }
    });
  const bool isLayer = beside != NoPlace &&
    std::abs(dot(told(beside, layers).sample.normal, sample.normal)) >= CosineOfLayerBeside;
  return isLayer ? gap : std::numeric_limits<float>::infinity();
}

PointLayers::Told PointLayers::told(std::uint32_t point, Layers layers)
{
  Known& known = this->known(point);
  if (layers == Layers::Apart)
  {
    LayerSample sample;
    sample.position = nearest().points()[point];
    sample.radius = known.joined.sample.radius;
    if (const auto isInLayer = search_.moveOntoOneOfTwo(sample, known.spacing.mean))
    {
      return { sample, *isInLayer, true };
    }
  }
  if (!known.isTold)
  {
    known.joined.isInLayer = search_.moveOntoLayer(known.joined.sample, known.spacing.mean);
    known.isTold = true;
  }
  return known.joined;
}

bool PointLayers::isInOneOfTwo(std::uint32_t point)
{
  return search_.isInOneOfTwo(nearest().points()[point], known(point).spacing.mean);
}
}
