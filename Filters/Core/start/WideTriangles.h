// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "start/LayerSamples.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The triangles of a mesh whose circle is larger than two radii of the samples at its corners: where
/// samples are that far apart, there may be nothing between them. Not those that join a piece of less
/// than 1/300 of the triangles to another: that is rather a sparse part of a surface than one of its
/// own.
std::vector<Triangle> findWideTriangles(const Mesh& mesh, std::span<const LayerSample> samples);

/// Fills the loops that can be filled wholly with triangles that are not wide: slits, however long they are.
/// Not the outlines of sheets. Returns their number.
std::size_t fillSlits(Mesh& mesh, std::span<const LayerSample> samples);
}
