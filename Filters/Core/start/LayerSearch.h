// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"
#include "cloud/NearestPoints.h"

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

/// How far points are from each other around one; those that coincide count as one.
struct Spacing
{
  float mean = 0.f;     ///< to its nearest neighbours
  float farthest = 0.f; ///< of these
};

Spacing spacingAt(const NearestPoints& nearest, std::uint32_t point);

/// Mean distance of a point to its nearest neighbours; those that coincide count as one.
float pointSpacing(const NearestPoints& nearest, std::uint32_t point);
/// Where a point lies on the layer that it forms with its neighbours; nothing if these lie anywhere.
std::optional<Vector4> placeInLayer(const NearestPoints& nearest, std::uint32_t point);

/// Finds the layers that places of a cloud lie in. `spacing` is about that of the points around.
class LayerSearch
{
public:
  explicit LayerSearch(const NearestPoints& nearest)
    : nearest_(nearest)
  {
  }

  const NearestPoints& nearest() const { return nearest_; }

  /// Moves a sample onto its layer, by as few of its nearest points as the noise needs. Returns whether it lies
  /// in one.
  bool moveOntoLayer(LayerSample& sample, float spacing);

  /// The same where there are two layers almost as close to each other as samples are: onto the one that it lies
  /// in. Nothing if there are not two: then the sample stays as it is.
  std::optional<bool> moveOntoOneOfTwo(LayerSample& sample, float spacing);

  /// Whether there are two, as far as the most points tell.
  bool isInOneOfTwo(Vector4 place, float spacing);

private:
  const NearestPoints& nearest_;
  std::vector<NearPoint> buffer_;
};
}
