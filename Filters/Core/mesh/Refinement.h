// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// What becomes of the edges around a new vertex.
enum class EdgesAfterSplit
{
  Flip,     ///< where triangles get better by it
  FlipFlat, ///< likewise, but for those that are not flat: creases stay
  Keep      ///< the surface stays what it is, so that nothing crosses what it did not before
};

/// Halves the longest edge, again and again, until there are `count` vertices, or no edge can be
/// split any more, or it is ended: then it returns false. New vertices have the highest indices. No
/// vertex may be erased.
bool refine(Mesh& mesh, std::size_t count, const Progress& progress,
  EdgesAfterSplit edges = EdgesAfterSplit::Flip);
}
