// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Vector4.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// How many of the points lie in each of so many voxels, on all threads. `voxelOf(point)` is `voxels` if none holds it.
template <typename VoxelOf>
std::vector<std::uint32_t> countsInVoxels(std::span<const Vector4> points, std::size_t voxels,
  const VoxelOf& voxelOf, const Executor& executor)
{
  constexpr std::size_t PointsPerRange = 65536;
  std::vector<std::uint32_t> counts(voxels, 0);
  executor.forEachRange(points.size(), PointsPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      // Points that follow each other are mostly in one voxel.
      std::size_t voxelOfRun = voxels;
      std::uint32_t run = 0;
      const auto addRun = [&]
      {
        if (voxelOfRun != voxels)
        {
          std::atomic_ref(counts[voxelOfRun]).fetch_add(run, std::memory_order_relaxed);
        }
      };
      for (const Vector4 point : points.subspan(begin, end - begin))
      {
        const std::size_t voxel = voxelOf(point);
        if (voxel != voxelOfRun)
        {
          addRun();
          voxelOfRun = voxel;
          run = 0;
        }
        ++run;
      }
      addRun();
    });
  return counts;
}
}
