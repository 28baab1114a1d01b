// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
/// A closed wedge with two sides of unit length, which meet at the edge x = z = 0 at an angle in degrees.
inline TriangleMesh makeWedge(double angle)
{
  const double half = 0.5 * angle * std::numbers::pi / 180.;
  const double x = std::cos(half), z = std::sin(half);
  return { { { 0, 0, 0 }, { x, 0, -z }, { x, 0, z }, { 0, 1, 0 }, { x, 1, -z }, { x, 1, z } },
    { { 0, 1, 2 }, { 3, 5, 4 }, { 0, 3, 4 }, { 0, 4, 1 }, { 1, 4, 5 }, { 1, 5, 2 }, { 2, 5, 3 },
      { 2, 3, 0 } } };
}
}
