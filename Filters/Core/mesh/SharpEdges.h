// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <array>
#include <vector>

namespace neuralmesh
{
using EdgeEnds = std::array<Eigen::Vector3d, 2>;

/// The edges along which a surface turns by more than `leastTurn`, in radians: those with a triangle that
/// goes on into none of the others there within that angle. Between two triangles the turn is what their
/// dihedral angle lacks of 180 degrees.
///
/// Points at the same place are one here: files often have a point for each of the normals that meet at an
/// edge. How triangles are oriented does not matter, nor how often one is there. An edge of one triangle
/// bounds the surface, and does not turn. Nothing is known of edges where a triangle is lower than
/// `leastHeight` over them: its plane is noise.
///
/// Each edge comes once, in an order that depends on the mesh alone. Points of triangles must be finite. Takes
/// O(n log n) for n triangles.
std::vector<EdgeEnds> sharpEdges(const TriangleMesh& mesh, double leastTurn, double leastHeight);
}
