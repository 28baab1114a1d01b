// SPDX-License-Identifier: BSD-3-Clause
#include "start/OccupiedVoxels.h"

#include "start/VoxelCounts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// Layers around the bulk.
constexpr std::size_t Margin = EmptyLayers + 1;
/// A voxel is occupied from this part of the usual number of points on.
constexpr double LeastPartOfUsual = 0.15;
/// At most this part is asked for because of outliers.
constexpr double MostPartOfUsual = 0.3;
/// Of the voxels with outliers alone, at most this part is taken for occupied.
constexpr double MostFalseVoxels = 0.005;
/// What is usual is found in cubes with so many along the longest side, each with those around it.
constexpr unsigned Blocks = 8;
/// Where the density is even, what is found so is a bit below what is usual in all of the cloud.
constexpr double UsualFactor = 1.25;

VoxelGrid gridAround(const PointCloud& cloud, unsigned resolution)
{
  const Eigen::Vector3d low = cloud.bulkMin().toDouble(), high = cloud.bulkMax().toDouble();
  VoxelGrid grid;
  grid.width = (high - low).maxCoeff() / resolution;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    const auto count = std::size_t(std::ceil((high - low)[axis] / grid.width)) + 2 * Margin;
    grid.counts[std::size_t(axis)] = count;
    grid.first[axis] = 0.5 * (low[axis] + high[axis]) - 0.5 * grid.width * (double(count) - 1.);
  }
  return grid;
}

std::vector<std::uint32_t> countPoints(
  const PointCloud& cloud, const VoxelGrid& grid, const Executor& executor)
{
  const auto strides = grid.strides();
  const Vector4 first(grid.first);
  const auto inverse = float(1. / grid.width);
  constexpr auto Begin = float(EmptyLayers);
  const auto endOf = [&](std::size_t axis) { return float(grid.counts[axis] - EmptyLayers); };
  const float endX = endOf(0), endY = endOf(1), endZ = endOf(2);
  const std::size_t none = grid.size();
  const auto voxelOf = [=](Vector4 point)
  {
    const Vector4 place = inverse * (point - first) + Vector4(0.5f, 0.5f, 0.5f);
    const bool isWithin = place[0] >= Begin && place[1] >= Begin && place[2] >= Begin &&
      place[0] < endX && place[1] < endY && place[2] < endZ;
    const auto along = [&](int axis)
    { return std::size_t(place[axis]) * strides[std::size_t(axis)]; };
    return isWithin ? along(0) + along(1) + along(2) : none;
  };
  return countsInVoxels(cloud.points(), grid.size(), voxelOf, executor);
}

struct FilledVoxel
{
  std::size_t index;
  std::uint32_t count;
  std::uint32_t block;
};

/// Cubes of voxels, for what is usual in them and around them.
class UsualCounts
{
public:
  UsualCounts(const VoxelGrid& grid, unsigned resolution)
    : width_(std::max(1u, resolution / Blocks))
    , strides_(grid.strides())
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // With an empty one at both ends.
      blocks_.counts[axis] = (grid.counts[axis] - 1) / width_ + 3;
    }
    means_.assign(blocks_.size(), 0.);
  }

  std::uint32_t block(std::size_t voxel) const
  {
    const auto& [sx, sy, sz] = strides_;
    const auto& [bx, by, bz] = blocks_.strides();
    return std::uint32_t((voxel % sy / width_ + 1) * bx + (voxel % sz / sy / width_ + 1) * by +
      (voxel / sz / width_ + 1) * bz);
  }

  /// The median of the fuller half of the voxels around, about. The mean of logarithms heeds a few
  /// voxels that are far too full as little as a median does.
  void find(std::span<const FilledVoxel> voxels)
  {
    // First the mean of all, then of those above it.
    for (int round = 0; round < 2; ++round)
    {
      std::vector<double> sums(means_.size(), 0.), numbers(means_.size(), 0.);
      for (const FilledVoxel& voxel : voxels)
      {
        const double logarithm = std::log(double(voxel.count));
        if (logarithm >= means_[voxel.block])
        {
          sums[voxel.block] += logarithm;
          numbers[voxel.block] += 1.;
        }
      }
      addAround(sums);
      addAround(numbers);
      for (std::size_t block = 0; block < sums.size(); ++block)
      {
        means_[block] = numbers[block] > 0. ? sums[block] / numbers[block] : 0.;
      }
    }
  }

  double usual(std::uint32_t block) const { return UsualFactor * std::exp(means_[block]); }

private:
  /// To each block its neighbours by side, edge and corner.
  void addAround(std::vector<double>& values) const
  {
    std::vector<double> before;
    for (const std::size_t stride : blocks_.strides())
    {
      before = values;
      for (std::size_t i = stride; i + stride < values.size(); ++i)
      {
        values[i] += before[i - stride] + before[i + stride];
      }
    }
  }

  unsigned width_;
  std::array<std::size_t, 3> strides_;
  VoxelGrid blocks_;
  std::vector<double> means_; ///< of logarithms
};

/// The number in the voxel of the median point. `counts` are those of voxels with points, in order.
/// Where noise and outliers reach there are many voxels with a point or two: by voxels the usual
/// would be theirs, by points it is not.
std::uint32_t usualCount(std::span<const std::uint32_t> counts)
{
  const std::size_t points = std::accumulate(counts.begin(), counts.end(), std::size_t(0));
  std::size_t before = 0;
  const auto median = std::find_if(counts.begin(), counts.end(),
    [&](std::uint32_t count) { return 2 * (before += count) >= points; });
  return *median;
}

/// So many points outliers alone bring to hardly any voxel, but at most `limit`. `counts` are those
/// of the voxels with points, in order, of `all` where points can be.
double leastAgainstOutliers(std::span<const std::uint32_t> counts, std::size_t all, double limit)
{
  // Most voxels have none but outliers.
  const std::size_t empty = all - counts.size();
  const auto single = std::upper_bound(counts.begin(), counts.end(), 1u) - counts.begin();
  const double mean =
    empty > all / 2 ? double(single) / double(empty) : double(counts[all / 2 - empty]);
  double least = 0., probability = std::exp(-mean), more = 1.;
  while (least < limit && more > MostFalseVoxels)
  {
    more -= probability;
    least += 1.;
    probability *= mean / least;
  }
  return std::min(least, limit);
}
}

OccupiedVoxels occupiedVoxels(
  const PointCloud& cloud, unsigned resolution, const Executor& executor)
{
  OccupiedVoxels result{ gridAround(cloud, resolution), {} };
  const VoxelGrid& grid = result.grid;
  result.isOccupied.assign(grid.size(), 0);
  const std::vector<std::uint32_t> counts = countPoints(cloud, grid, executor);
  UsualCounts usualCounts(grid, resolution);
  std::vector<FilledVoxel> filled;
  std::vector<std::uint32_t> sorted;
  for (std::size_t i = 0; i < counts.size(); ++i)
  {
    if (counts[i] > 0)
    {
      filled.push_back({ i, counts[i], usualCounts.block(i) });
      sorted.push_back(counts[i]);
    }
  }
  if (filled.empty())
  {
    return result;
  }
  std::sort(sorted.begin(), sorted.end());
  const double usual = usualCount(sorted);
  std::size_t all = 1;
  for (const std::size_t count : grid.counts)
  {
    all *= count - 2 * EmptyLayers;
  }
  const double least = leastAgainstOutliers(sorted, all, MostPartOfUsual * usual);
  std::erase_if(filled, [&](const FilledVoxel& voxel) { return double(voxel.count) < least; });
  usualCounts.find(filled);
  for (const auto& [voxel, count, block] : filled)
  {
    const double around = std::min(usual, usualCounts.usual(block));
    result.isOccupied[voxel] = std::uint8_t(double(count) >= LeastPartOfUsual * around);
  }
  return result;
}
}
