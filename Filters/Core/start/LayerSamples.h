// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "base/Vector4.h"
#include "cloud/NearestPoints.h"
#include "start/LocalLayer.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// A place on the surface that a cloud was taken from.
struct LayerSample
{
  Vector4 position;
  Vector4
    normal; ///< of unit length, its sign says nothing; zero if points on a line do not tell it
  float radius = 0.f; ///< no other sample is closer than about that
  float noise = 0.f;  ///< standard deviation of the points across the surface
  float error = 0.f;  ///< about how far it lies off the surface because of that
};

/// Mean distance of a point to its nearest neighbours; those that coincide count as one.
float pointSpacing(const NearestPoints& nearest, std::uint32_t point);
/// Where a point lies on the layer that it forms with its neighbours; nothing if these lie anywhere.
std::optional<Vector4> placeInLayer(const NearestPoints& nearest, std::uint32_t point);

struct LayerSamples
{
  std::vector<LayerSample> all;
  std::size_t inNoLayer = 0; ///< that were tried, and left out
  /// Share of the samples that lie in one of two layers almost as close to each other as samples are. Asked
  /// where layers are joined, of some.
  double inOneOfTwo = 0.;
};

/// About `count` places, evenly spread for the density that the cloud has there: each farther from
/// the others than a radius that grows with the root of the distance between points. (A radius that
/// grows with the distance itself leaves nothing of what is sparse.) Each is moved onto the layer that
/// it lies in by as few of its nearest points as the noise needs; what lies in no layer is left out.
/// None at all if a quarter of them lies in no layer, or it was ended before, or it is sure that more than the
/// part `mostInNoLayer` does: that is known early where outliers are in all of space.
LayerSamples layerSamples(const NearestPoints& nearest, std::size_t count, Layers layers,
  std::uint64_t seed, const Progress& progress, double mostInNoLayer);
}
