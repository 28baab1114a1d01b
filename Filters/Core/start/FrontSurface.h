// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "start/LayerSamples.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace neuralmesh
{
/// A surface by an advancing front, and how well the samples agreed to make one.
struct FrontSurface
{
  Mesh mesh;
  std::size_t samples = 0;
  double scatter = 0.;         ///< share of the samples that lie in no layer, and were left out
  std::size_t filledLoops = 0; ///< small ones that the front had left
  double inOneOfTwo = 0.;      ///< see LayerSamples
  std::size_t crossings = 0; ///< pairs of triangles that intersected, before these were taken away
  /// It goes on to the edges of wedges, and has folds there. Only bestFront() knows, where another front does not.
  bool reachesEdges = false;

  /// Loops filled and crossings, for a thousand samples. Surfaces have few; where it is many the samples
  /// tell no surface.
  double disorder() const
  {
    return samples > 0 ? 1000. * double(filledLoops + crossings) / double(samples) : 0.;
  }
};

/// Of all triangles; smaller pieces are left over from points that lie on no surface.
inline constexpr double LeastPiece = 0.0005;

/// The surface of samples on the layers of the cloud, as many as there is to be: with boundaries where the cloud ends,
/// and as many pieces as that has. Without pieces of less than `leastPiece` of the triangles. Nothing if
/// there are too few points, it was ended before, or it is sure while samples are taken that more than the
/// part `mostScatter` of them lies in no layer.
std::optional<FrontSurface> frontSurface(const PointCloud& cloud, PointLayers& pointLayers,
  Layers layers, std::uint64_t seed, const Progress& progress, double leastPiece = LeastPiece,
  double mostScatter = 1.);
}
