// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "start/LayerSamples.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// A surface through samples, by a front that advances from the smallest triangles on (Cohen-Steiner and
/// Da 2004): of the Delaunay triangles at an edge of the front that one is taken whose smallest empty
/// ball is the smallest, first where the surface goes on smoothly, then where it bends. So the surface
/// ends where there are no samples, and it may have many pieces.
///
/// Triangles whose circle is larger than three radii of the samples at its corners are left out. The
/// triangles are oriented, and no edge has more than two; but a vertex may have several fans.
std::vector<std::array<std::uint32_t, 3>> advancingFront(
  std::span<const LayerSample> samples, Layers layers);
}
