// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"
#include "mesh/SelfIntersections.h"
#include "mesh/TriangleShape.h"

namespace neuralmesh
{
/// Triangles turned against each other by more than about 143 degrees count as a fold; a bit less than what is mended in
/// the end.
inline constexpr float CosineOfFanFold = -0.8f;

/// Whether the surface folds at an edge of a closed fan of triangles with its centre at `place`. Each of the `sides` has
/// the corners of a triangle, `first` and `second`, and `inner` lies on the same side of these as the centre before.
template <typename Sides>
bool isFanFolded(const Mesh& mesh, const Sides& sides, Vector4 place)
{
  const auto normalOf = [&](const auto& side)
  { return cross(mesh.position(side.first) - place, mesh.position(side.second) - place); };
  for (const auto& side : sides)
  {
    const Vector4 normal = normalOf(side);
    for (const auto& next : sides)
    {
      if (next.first == side.second && cosineBetween(normal, normalOf(next)) < CosineOfFanFold)
      {
        return true;
      }
    }
    if (mesh.isBoundaryEdge(side.first, side.second))
    {
      continue;
    }
    const Edge opposite = oppositeTo(mesh, { side.first, side.second });
    const VertexIndex beyond = opposite[0] == side.inner ? opposite[1] : opposite[0];
    const Vector4 from = mesh.position(side.first);
    const Vector4 outside = cross(mesh.position(beyond) - from, mesh.position(side.second) - from);
    if (cosineBetween(normal, outside) < CosineOfFanFold)
    {
      return true;
    }
  }
  return false;
}
}
