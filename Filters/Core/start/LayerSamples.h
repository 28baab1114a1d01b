// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "start/PointLayers.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
struct LayerSamples
{
  std::vector<LayerSample> all;
  std::size_t inNoLayer = 0; ///< that were tried, and left out
  /// Share of the samples that lie in one of two layers almost as close to each other as samples are. Asked
  /// where layers are joined, of some.
  double inOneOfTwo = 0.;
};

/// About as many places as the layers have room for, evenly spread for the density that the cloud has there: each
/// farther from the others than its radius, and moved onto its layer; what lies in no layer is left out.
/// None at all if a quarter of them lies in no layer, or it was ended before, or it is sure that more than the
/// part `mostInNoLayer` does: that is known early where outliers are in all of space.
LayerSamples layerSamples(PointLayers& pointLayers, Layers layers, std::uint64_t seed,
  const Progress& progress, double mostInNoLayer);
}
