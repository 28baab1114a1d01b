// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Shapes.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <set>

namespace neuralmesh::testing
{
/// Two cubes of side 1, the first at the origin, that look at each other along x, and what may join them.
struct JoinedCubes
{
  TriangleMesh bodies; ///< closed, each for itself
  TriangleMesh tube;   ///< only the triangles of a tube between them, open at its ends
  TriangleMesh joined; ///< both by the tube, with the same points
};

/// Squares have sides of 0.05; of each face that looks at the other cube those within the half width and height belong to
/// the tube.
inline JoinedCubes joinedCubes(double distance, double halfWidth, double halfHeight)
{
  const TriangleMesh cube = makeCube(20);
  const auto all = std::uint32_t(cube.points.size());
  JoinedCubes result;
  result.bodies = cube;
  for (const Eigen::Vector3d& point : cube.points)
  {
    result.bodies.points.emplace_back(1. + distance - point.x(), point.y(), point.z());
  }
  result.tube.points = result.joined.points = result.bodies.points;
  std::set<std::array<std::uint32_t, 2>> edges;
  for (const auto& [a, b, c] : cube.triangles)
  {
    result.bodies.triangles.push_back({ all + a, all + c, all + b });
    const Eigen::Vector3d center = (cube.points[a] + cube.points[b] + cube.points[c]) / 3.;
    if (center.x() > 0.49 && std::abs(center.y()) < halfWidth && std::abs(center.z()) < halfHeight)
    {
      edges.insert({ { a, b }, { b, c }, { c, a } });
    }
    else
    {
      result.joined.triangles.push_back({ a, b, c });
      result.joined.triangles.push_back({ all + a, all + c, all + b });
    }
  }
  for (const auto& [a, b] : edges)
  {
    if (!edges.contains({ b, a }))
    {
      result.tube.triangles.push_back({ a, b, all + b });
      result.tube.triangles.push_back({ a, all + b, all + a });
    }
  }
  result.joined.triangles.insert(
    result.joined.triangles.end(), result.tube.triangles.begin(), result.tube.triangles.end());
  return result;
}
}
