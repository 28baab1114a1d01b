// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/TriangleMesh.h"

namespace neuralmesh
{
/// Makes a mesh to learn on from triangles in the coordinates of the input, in those of `cloud`.
/// The triangles must be an oriented 2-manifold, with or without boundary: if they are not, throws
/// std::runtime_error with a text that tells why, and where by the indices of points. Points that
/// no triangle uses are left out.
///
/// Vertices with more neighbours than a ring takes are split until all rings fit. A mesh in which
/// growth would find no vertex to split, such as a single triangle, gets its longest boundary edge
/// split until there is one.
///
/// Takes O(n log n) for n triangles.
Mesh buildMesh(TriangleMesh triangles, const PointCloud& cloud);

/// The way back. No vertex may be erased, so that indices are those of the mesh.
TriangleMesh trianglesOf(
  const Mesh& mesh, const PointCloud& cloud, const Executor& executor = Executor::sequential());
}
