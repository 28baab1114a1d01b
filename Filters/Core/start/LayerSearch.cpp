// SPDX-License-Identifier: BSD-3-Clause
#include "start/LayerSearch.h"

#include "start/LocalLayer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace neuralmesh
{
namespace
{
/// Neighbours that tell the distance between points.
constexpr std::size_t Neighbors = 7;
/// Points that a layer is told by, the fewest that make the error small against the radius; and the part
/// of their scatter that is left where a quadric is fitted to so few.
struct LayerPoints
{
  std::size_t count;
  float scatterLeft;
};
constexpr std::array<LayerPoints, 3> LayerPointsTried{ { { 16, 0.44f }, { 32, 0.63f },
  { 64, 0.79f } } };
/// Of two layers that are almost as far apart as points that tell; fewer where a layer ends.
constexpr LayerPoints PointsOfTwoLayers{ MostPointsOfLayer, 0.86f };
constexpr std::array<LayerPoints, 3> PointsOfTwoLayersTried{ { PointsOfTwoLayers, { 48, 0.73f },
  { 24, 0.55f } } };
constexpr std::size_t LeastThatTell = 6;
constexpr float SmallError = 0.04f;
/// About, of as many points of a surface: for the root of their number and the distance to the nearest
/// seven, or where it is known how far off as many were.
constexpr float RadiusBySpacing = 0.62f;
constexpr float RadiusByOthers = 1.15f;
/// With less, points lie along a line of the scanner, and the layer may turn about it.
constexpr float LeastBreadth = 0.15f;
/// A layer that is told anew from where the sample was moved to.
constexpr float NoticeableError = 0.02f;
/// A move farther than this part of the radius of the points that tell is none onto a surface.
constexpr float FarthestMove = 0.7f;
/// Points that spread so much of their radius across are in no layer.
constexpr float ScatterOfNoLayer = 0.25f;

/// The points nearest to a place.
class Around
{
public:
  Around(const NearestPoints& nearest, Vector4 place, float spacing, std::vector<NearPoint>& buffer)
    : nearest_(nearest)
    , place_(place)
    , radius_(RadiusBySpacing * spacing)
    , buffer_(buffer)
  {
  }
  /// Near a place that is known.
  Around(const Around& other, Vector4 place)
    : nearest_(other.nearest_)
    , place_(place)
    , radius_(other.radius_)
    , buffer_(other.buffer_)
  {
  }

  Vector4 place() const { return place_; }
  std::span<const Vector4> points() const { return nearest_.points(); }

  /// So many, or all. Who asks for more than before may ask for more again: then as many as `most` are found at
  /// once.
  std::span<const NearPoint> nearest(std::size_t count, std::size_t most = MostPointsOfLayer)
  {
    if (count > asked_)
    {
      asked_ = asked_ > 0 ? std::max(count, most) : count;
      const float root = std::sqrt(float(asked_));
      found_ = nearest_.findWithin(place_, root * radius_, std::span(all_).first(asked_), buffer_);
      radius_ = RadiusByOthers * std::sqrt(all_[found_ - 1].squaredDistance) / root;
    }
    return std::span(all_).first(std::min(count, found_));
  }

private:
  const NearestPoints& nearest_;
  Vector4 place_;
  float radius_; ///< that about one point is expected within
  std::vector<NearPoint>& buffer_;
  std::array<NearPoint, MostPointsOfLayer> all_;
  std::size_t asked_ = 0;
  std::size_t found_ = 0;
};

/// A layer, and what the points that tell it leave in the dark.
struct Told
{
  LocalLayer layer;
  LayerPoints points{};
  float noise = 0.f;
  float error = 0.f;
};

Told toldBy(const LayerPoints& points, const LocalLayer& layer)
{
  const float noise = layer.scatter / points.scatterLeft;
  return { layer, points, noise, noise * std::sqrt(6.f / float(points.count)) };
}

std::optional<Told> tell(Around& around, const LayerPoints& points)
{
  const auto nearest = around.nearest(points.count, LayerPointsTried.back().count);
  return nearest.size() < LeastThatTell
    ? std::nullopt
    : std::optional(toldBy(points, localLayer(around.place(), around.points(), nearest)));
}

std::optional<Told> tellOfTwo(Around& around, const LayerPoints& points)
{
  const auto nearest = around.nearest(points.count);
  const auto layer = nearest.size() < LeastThatTell
    ? std::nullopt
    : layerOfTwo(around.place(), around.points(), nearest);
  return layer ? std::optional(toldBy(points, *layer)) : std::nullopt;
}

/// By as few points as the noise needs, for samples of this radius.
std::optional<Told> tellByFew(Around& around, float radius)
{
  std::optional<Told> best;
  for (const LayerPoints& points : LayerPointsTried)
  {
    const auto told = tell(around, points);
    if (told && (!best || best->layer.breadth < LeastBreadth || told->error < best->error))
    {
      best = told;
    }
    if (best && best->error <= SmallError * radius && best->layer.breadth >= LeastBreadth)
    {
      break;
    }
  }
  return best;
}

bool isNear(const LocalLayer& layer) { return layer.distance < FarthestMove * layer.radius; }

void turnAlong(LayerSample& sample, const LocalLayer& layer)
{
  sample.normal = layer.breadth >= LeastBreadth ? layer.normal : Vector4();
}

/// Moves a sample onto a layer, and onto that which `tellAgain(place)` tells from there if the error may be
/// noticed. Returns whether it lies in one.
template <typename TellAgain>
bool moveOnto(LayerSample& sample, const Told& told, TellAgain tellAgain)
{
  sample.position = isNear(told.layer) ? told.layer.position : sample.position;
  turnAlong(sample, told.layer);
  sample.noise = told.noise;
  sample.error = told.error;
  if (told.error > NoticeableError * sample.radius)
  {
    const auto again = tellAgain(sample.position);
    if (again && isNear(again->layer))
    {
      sample.position = again->layer.position;
      turnAlong(sample, again->layer);
    }
  }
  return told.noise < ScatterOfNoLayer * told.layer.radius;
}
}

Spacing spacingAt(const NearestPoints& nearest, std::uint32_t point)
{
  std::array<NearPoint, Neighbors> found;
  const std::size_t count = nearest.findPlaces(point, found);
  float sum = 0.f;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += std::sqrt(found[i].squaredDistance);
  }
  return { count > 0 ? sum / float(count) : 0.f,
    count > 0 ? std::sqrt(found[count - 1].squaredDistance) : 0.f };
}

float pointSpacing(const NearestPoints& nearest, std::uint32_t point)
{
  return spacingAt(nearest, point).mean;
}

std::optional<Vector4> placeInLayer(const NearestPoints& nearest, std::uint32_t point)
{
  LayerSample sample;
  sample.position = nearest.points()[point];
  const Spacing spacing = spacingAt(nearest, point);
  sample.radius = spacing.farthest;
  LayerSearch search(nearest);
  return search.moveOntoLayer(sample, spacing.mean) ? std::optional(sample.position) : std::nullopt;
}

bool LayerSearch::moveOntoLayer(LayerSample& sample, float spacing)
{
  Around around(nearest_, sample.position, spacing, buffer_);
  const auto told = tellByFew(around, sample.radius);
  return told &&
    moveOnto(sample, *told,
      [&](Vector4 place)
      {
        Around moved(around, place);
        return tell(moved, told->points);
      });
}

std::optional<bool> LayerSearch::moveOntoOneOfTwo(LayerSample& sample, float spacing)
{
  Around around(nearest_, sample.position, spacing, buffer_);
  for (const LayerPoints& points : PointsOfTwoLayersTried)
  {
    if (const auto told = tellOfTwo(around, points))
    {
      return moveOnto(sample, *told,
        [&](Vector4 place)
        {
          Around moved(around, place);
          const auto again = tellOfTwo(moved, points);
          return again ? again : tell(moved, points);
        });
    }
  }
  return {};
}

bool LayerSearch::isInOneOfTwo(Vector4 place, float spacing)
{
  Around around(nearest_, place, spacing, buffer_);
  return tellOfTwo(around, PointsOfTwoLayers).has_value();
}
}
