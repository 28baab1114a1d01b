// SPDX-License-Identifier: BSD-3-Clause
#include "start/VoxelSurface.h"

#include <bit>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Points of the surface lie at corners of voxels. Corner (x, y, z) is the lowest corner of that
/// voxel; the eight voxels around it are numbered by bits: bit k tells that the voxel lies on the
/// high side of the corner along axis k.
class SurfaceMaker
{
public:
  SurfaceMaker(const VoxelGrid& grid, std::span<const std::uint8_t> inside)
    : grid_(grid)
    , inside_(inside)
    , strides_(grid.strides())
    , points_(grid.size(), NoPoint)
  {
  }

  TriangleMesh make()
  {
    forEachVoxel(grid_,
      [&](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        const std::array<std::size_t, 3> place{ x, y, z };
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          if (place[axis] > 0 && inside_[index] != inside_[index - strides_[axis]])
          {
            addSide(index, place, axis);
          }
        }
      });
    return std::move(mesh_);
  }

private:
  static constexpr std::uint32_t NoPoint = 0xffffffffu;

  /// The side between a voxel and the one before it along an axis.
  void addSide(std::size_t voxel, const std::array<std::size_t, 3>& place, std::size_t axis)
  {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const bool isInside = inside_[voxel] != 0;
    std::array<std::uint32_t, 4> points{};
    for (unsigned i = 0; i < 4; ++i)
    {
      // Counter-clockwise as seen from the high side.
      const bool alongU = i == 1 || i == 2, alongV = i >= 2;
      std::array<std::size_t, 3> corner = place;
      corner[u] += alongU ? 1 : 0;
      corner[v] += alongV ? 1 : 0;
      const unsigned high = (1u << axis) | (alongU ? 0u : 1u << u) | (alongV ? 0u : 1u << v);
      points[i] = pointAt(corner, high, high & ~(1u << axis));
    }
    if (isInside)
    {
      std::swap(points[1], points[3]);
    }
    mesh_.triangles.push_back({ points[0], points[1], points[2] });
    mesh_.triangles.push_back({ points[0], points[2], points[3] });
  }

  /// The point at a corner for a side between two of the voxels around it.
  std::uint32_t pointAt(const std::array<std::size_t, 3>& corner, unsigned high, unsigned low)
  {
    std::size_t lattice = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lattice += corner[axis] * strides_[axis];
    }
    unsigned around = 0;
    for (unsigned i = 0; i < 8; ++i)
    {
      const std::size_t back =
        (i & 1 ? 0 : strides_[0]) + (i & 2 ? 0 : strides_[1]) + (i & 4 ? 0 : strides_[2]);
      around |= inside_[lattice - back] != 0 ? 1u << i : 0u;
    }
    // Two voxels of a kind that touch by the corner alone have a point each.
    const unsigned few = std::popcount(around) == 2 ? around : ~around & 0xffu;
    const bool isContact = std::popcount(few) == 2 &&
      unsigned(std::countr_zero(few)) + unsigned(std::bit_width(few)) - 1u == 7u;
    const unsigned part = isContact ? ((few >> high & 1u) != 0 ? high : low) : 0u;
    std::uint32_t& point = part == 0
      ? points_[lattice]
      : contacts_.try_emplace(8 * std::uint64_t(lattice) + part, NoPoint).first->second;
    if (point == NoPoint)
    {
      point = std::uint32_t(mesh_.points.size());
      const Eigen::Vector3d center = grid_.center(corner[0], corner[1], corner[2]);
      mesh_.points.push_back(center - Eigen::Vector3d::Constant(0.5 * grid_.width));
    }
    return point;
  }

  const VoxelGrid& grid_;
  std::span<const std::uint8_t> inside_;
  std::array<std::size_t, 3> strides_;
  std::vector<std::uint32_t> points_;                         ///< at each corner
  std::unordered_map<std::uint64_t, std::uint32_t> contacts_; ///< of the other parts, which are few
  TriangleMesh mesh_;
};
}

TriangleMesh voxelSurface(const VoxelGrid& grid, std::span<const std::uint8_t> inside)
{
  return SurfaceMaker(grid, inside).make();
}
}
