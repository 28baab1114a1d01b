// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

namespace neuralmesh
{
/// From which view a point of a cloud was seen; UnknownView if that is not known.
using PointViews = std::function<std::uint32_t(std::size_t)>;
inline constexpr std::uint32_t UnknownView = std::numeric_limits<std::uint32_t>::max();

/// Noise across a surface in two parts, as standard deviations: of each point for itself, and of all points of a view
/// together, as views are not registered exactly.
struct NoiseParts
{
  double own = 0.;
  double shared = 0.; ///< 0 if none is told
};

/// Tells the parts of the noise by the distances of samples to a mesh that is smooth against them, on patches of
/// some forty samples, which may lie in several layers. Samples do not count that are nearest to a vertex for which
/// `isLeftOut` is not 0: at creases, and where the other side of a thin part is near, distances tell more than noise.
///
/// With the views of the samples, by an analysis of variance: the means of views on a patch lie farther apart than
/// their points explain. However small the shared part is, it is told, if enough patches are seen by several views.
///
/// Without (`views` is empty), by the fourth cumulant of the distances. It is 0 for Gaussian noise, positive for noise
/// that has more outliers or differs from point to point, and negative for layers: for n of them, which lie apart by
/// chance with the variance b^2, it is expected to be -6 b^4 (n - 1) / n^2, about -5/4 b^4 for two to six. So a shared
/// part is told that is larger than some two thirds of all noise. What else is spread flatly counts as shared:
/// depths that are rounded by more than their noise. So no layers are told where all noise is less than `step`, by
/// which coordinates are rounded in single precision.
///
/// O(n log n); one thread, so that there is one result.
NoiseParts noisePartsOf(const Mesh& mesh, const PlacedSamples& samples,
  std::span<const std::uint8_t> isLeftOut, std::span<const std::uint32_t> views, double step = 0.);
}
