// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Makes a mesh of `count` vertices of a surface that has as many or more: simplifies it by quadrics, and flips edges
/// where the surface is flat. It has more vertices where its topology needs them. No vertex may be erased, and
/// none is in the end. Returns false if it was ended before its end; then the mesh is valid all the same.
bool startFromSurface(Mesh& mesh, std::size_t count, const Progress& progress);
}
