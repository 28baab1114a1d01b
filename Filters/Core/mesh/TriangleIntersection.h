// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>

namespace neuralmesh
{
/// The corners of a triangle in space, whose coordinates are numbers of single precision.
using Corners = std::array<Eigen::Vector3d, 3>;

/// Whether two triangles have a point in common. A point that lies on a plane or a line within the
/// rounding of double precision, which is far below that of the coordinates, counts as on it, so
/// triangles that touch intersect. Triangles without area intersect only those with an area.
bool intersect(const Corners& first, const Corners& second);

/// Whether two triangles with the same first corner have another point in common.
bool intersectBesidesFirstCorner(const Corners& first, const Corners& second);

/// Whether the segment p-q meets a triangle, from one side of it to the other or in its plane.
bool passesThrough(const Corners& triangle, const Eigen::Vector3d& p, const Eigen::Vector3d& q);

/// Whether two triangles with the same first two corners lie on each other: on the same side of
/// that edge, and in one plane within the rounding of coordinates of single precision.
bool lieOnEachOther(const Corners& first, const Corners& second);
}
