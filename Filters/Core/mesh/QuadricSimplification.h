// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <functional>
#include <span>

namespace neuralmesh
{
/// Collapses the edge that moves the surface least, again and again, until no more than `count` vertices
/// are left, or no collapse is legal any more: so what is thin stays longer than by simplify(). The
/// vertex goes where it is nearest to the planes of the triangles that are gone (M. Garland and
/// P. Heckbert, *Surface simplification using quadric error metrics*, 1997). Handles, boundaries and pieces
/// stay. In the end, no vertex is erased.
void simplifyByQuadrics(Mesh& mesh, std::size_t count);
/// The same; returns false if `progress` ended it, with more vertices.
bool simplifyByQuadrics(Mesh& mesh, std::size_t count, const Progress& progress);

/// The same for several meshes, in little more time than for the smallest: the numbers of vertices
/// descend, and `reached` is called at each. It returns false to end. Then, and while it is called,
/// some vertices are erased.
void simplifyByQuadricsToEach(
  Mesh& mesh, std::span<const std::size_t> counts, const std::function<bool()>& reached);

/// The same of a surface that is not learnt afterwards: creases and tips count for more, against short edges, and where
/// a triangle would be nearly a line, an edge goes late.
void simplifySurface(Mesh& mesh, std::size_t count);
}
