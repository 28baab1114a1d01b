// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace neuralmesh
{
/// Cubic voxels in rows along x, rows side by side along y, layers along z. What is said of a voxel
/// is said of its centre.
struct VoxelGrid
{
  Eigen::Vector3d first = Eigen::Vector3d::Zero(); ///< centre of the first voxel
  double width = 1.;                               ///< of a voxel
  std::array<std::size_t, 3> counts{ 0, 0, 0 };    ///< of voxels along x, y, z

  std::size_t size() const { return counts[0] * counts[1] * counts[2]; }
  /// From a voxel to the next one along an axis.
  std::array<std::size_t, 3> strides() const { return { 1, counts[0], counts[0] * counts[1] }; }
  Eigen::Vector3d center(std::size_t x, std::size_t y, std::size_t z) const
  {
    return first + width * Eigen::Vector3d(double(x), double(y), double(z));
  }
  /// The voxel that holds a point; size() if none does.
  std::size_t voxelAt(const Eigen::Vector3d& point) const
  {
    const auto steps = strides();
    std::size_t voxel = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = Eigen::Index(axis);
      const double place = (point[a] - first[a]) / width + 0.5;
      if (!(place >= 0. && place < double(counts[axis])))
      {
        return size();
      }
      voxel += std::size_t(place) * steps[axis];
    }
    return voxel;
  }
};

/// Calls `use(index, x, y, z)` for every voxel, in order.
template <typename Use>
void forEachVoxel(const VoxelGrid& grid, Use use)
{
  std::size_t index = 0;
  for (std::size_t z = 0; z < grid.counts[2]; ++z)
  {
    for (std::size_t y = 0; y < grid.counts[1]; ++y)
    {
      for (std::size_t x = 0; x < grid.counts[0]; ++x)
      {
        use(index++, x, y, z);
      }
    }
  }
}
}
