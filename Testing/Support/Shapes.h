// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

namespace neuralmesh
{
/// Shapes to draw clouds from, around the origin, closed and oriented outwards. `resolution` is the
/// number of quadrangles (two triangles each) along a side.

/// An axis-parallel cube of side 1.
TriangleMesh makeCube(unsigned resolution = 1);
/// A sphere of radius 1: a cube blown up.
TriangleMesh makeSphere(unsigned resolution = 64);
/// A torus around the z axis: distance of the tube's centre from the axis 1, radius of the tube as
/// given. It has 2 * resolution quadrangles around the axis and `resolution` around the tube.
TriangleMesh makeTorus(double tubeRadius = 0.4, unsigned resolution = 128);

/// Adds another mesh, shifted, as a piece of its own.
void append(TriangleMesh& mesh, const TriangleMesh& other,
  const Eigen::Vector3d& shift = Eigen::Vector3d::Zero());
}
