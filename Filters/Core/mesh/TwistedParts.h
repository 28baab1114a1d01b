// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Cuts off and turns the parts of an open mesh that hang on to the rest by narrow necks, and look to the other side
/// than the rest: a roof that is joined to the ground by the leaves of a tree. In a neck a surface may be twisted by
/// chance, so that the boundaries of its parts tell more: those that face each other across openings, see
/// FacingBoundaries.h.
///
/// Parts are what is left where strips of a few triangles beside the boundaries are taken away, with what is nearest
/// to each. Parts are turned against each other so that the least length speaks against it: of boundaries that
/// contradict each other, and of necks that are cut. Two that face each other with their fronts, as floor and ceiling,
/// say nothing and stay as they are.
///
/// The triangles at the cuts are removed; vertices without triangles are erased. Returns how many parts were cut off.
std::size_t separateTwistedParts(Mesh& mesh);
}
