// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Mesh.h"

namespace neuralmesh
{
/// Flips the edges at `v` and those opposite to it as long as that brings valences closer to
/// regular, but none whose new triangles would fold over or lean far apart where the old ones do
/// not. Returns the number of flips. Not in the thesis.
unsigned improveValencesAround(Mesh& mesh, VertexIndex v);
}
