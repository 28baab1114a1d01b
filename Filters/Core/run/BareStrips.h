// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/NearestPoints.h"
#include "cloud/PointCloud.h"
#include "mesh/NumberedTriangles.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// What is known of triangles already.
struct BareTriangles
{
  std::span<const std::uint8_t> hasPoints; ///< see MeasuredPoints
  std::size_t points;                      ///< how many were asked for it
  const NearestPoints& nearest;            ///< of the whole cloud
  float median;                            ///< of the distances between points and the mesh
};

/// The triangles of a mesh, by their numbers, in each strip of it that has no points and is too long for chance, the
/// longest first. Where a gap of the cloud is hardly wider than triangles, each of them reaches points, and no place is
/// far from all of them: but places as bare as one in a thousand lie side by side along it.
///
/// Points are as far from each other as they are around the strip, and lie within `noise` of the mesh.
std::vector<std::vector<std::uint32_t>> bareStrips(const Mesh& mesh,
  const NumberedTriangles& triangles, const BareTriangles& bare, const PointCloud& cloud,
  float noise, const Executor& executor = Executor::sequential());
}
