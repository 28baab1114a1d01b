// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
/// Two triangles that share the edge 0-2.
inline TriangleMesh makeSquare()
{
  return { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 } } };
}

/// Point 0 in the origin, and triangles to so many points on the unit circle, all around or over
/// the half of it.
inline TriangleMesh makeTriangleFan(unsigned rim, bool isClosed)
{
  TriangleMesh fan;
  fan.points.emplace_back(0., 0., 0.);
  for (unsigned i = 0; i < rim; ++i)
  {
    const double angle = (isClosed ? 2. : 1.) * std::numbers::pi * i / rim;
    fan.points.emplace_back(std::cos(angle), std::sin(angle), 0.);
    if (i > 0)
    {
      fan.triangles.push_back({ 0, i, i + 1 });
    }
  }
  if (isClosed)
  {
    fan.triangles.push_back({ 0, rim, 1 });
  }
  return fan;
}

/// The unit square, in so many quadrangles along each side.
inline TriangleMesh makeGrid(unsigned side)
{
  TriangleMesh grid;
  for (unsigned i = 0; i <= side; ++i)
  {
    for (unsigned j = 0; j <= side; ++j)
    {
      grid.points.emplace_back(double(i) / side, double(j) / side, 0.);
    }
  }
  for (unsigned i = 0; i < side; ++i)
  {
    for (unsigned j = 0; j < side; ++j)
    {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      grid.triangles.push_back({ a, b, b + 1 });
      grid.triangles.push_back({ a, b + 1, a + 1 });
    }
  }
  return grid;
}
}
