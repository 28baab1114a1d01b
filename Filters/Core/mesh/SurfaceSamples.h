// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/ManifoldSurface.h"
#include "mesh/TriangleMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// Points of a surface, evenly spread over its area, and where each of them lies.
struct SurfaceSamples
{
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3f> normals;       ///< of the surface, of length 1
  std::vector<std::uint32_t> triangles;       ///< of the input, on which they lie
  std::vector<std::array<double, 3>> weights; ///< of the three corners, which add up to 1
};

/// One point in each of `count` equal shares of the area, drawn by `seed`. `surface` is made of `input`. Throws
/// std::runtime_error, with a text that tells why, if there is no area.
SurfaceSamples sampleSurface(
  const TriangleMesh& input, const ManifoldSurface& surface, std::size_t count, std::uint64_t seed);
}
