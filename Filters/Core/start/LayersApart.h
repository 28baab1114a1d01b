// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "start/LayerSamples.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The same samples, with those of layers that are closer to each other than samples are moved away from
/// each other: where two layers lie that close, Delaunay triangles go from one to the other, and there are
/// none within a layer. What a triangulation of the moved samples joins lies in one layer of theirs.
std::vector<LayerSample> layersApart(std::span<const LayerSample> samples);
}
