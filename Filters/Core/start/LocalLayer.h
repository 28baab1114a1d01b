// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/NearestPoints.h"

#include <cstddef>
#include <optional>
#include <span>

namespace neuralmesh
{
/// The piece of surface that a place in a cloud lies on, by the points around it.
struct LocalLayer
{
  Vector4 position;     ///< the place, moved along the normal onto the layer
  Vector4 normal;       ///< of unit length; its sign says nothing
  float radius = 0.f;   ///< of the points that tell
  float scatter = 0.f;  ///< standard deviation of the points of the layer across it
  float distance = 0.f; ///< by which the place was moved
  float breadth =
    0.f; ///< of the points: standard deviation where they are narrowest, over the radius
};

/// Most points that can tell of one layer.
inline constexpr std::size_t MostPointsOfLayer = 96;

/// Finds the layer next to `place` by its nearest points: a plane by principal components, of those
/// points alone that lie in one layer with the place, as another side of a plate may be closer than
/// they are; then a quadric of the heights, with less and less weight to what lies off it. `nearest` must be
/// in order, at least 6 and at most MostPointsOfLayer.
LocalLayer localLayer(
  Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest);

/// The same of two layers that are almost as far apart as the points that tell, which should be many: of the
/// one that the place lies in. Nothing if there are not two.
std::optional<LocalLayer> layerOfTwo(
  Vector4 place, std::span<const Vector4> points, std::span<const NearPoint> nearest);
}
