// SPDX-License-Identifier: BSD-3-Clause
#include "start/OutlierClusters.h"

#include "base/Median.h"
#include "cloud/NearestPoints.h"
#include "start/LocalLayer.h"
#include "start/OccupiedSolid.h"
#include "start/OccupiedVoxels.h"
#include "start/SeparateClusters.h"
#include "start/VoxelMajority.h"
#include "start/VoxelNeighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
using Voxels = std::vector<std::uint8_t>;

constexpr unsigned Resolution = 64;
/// Of a scan with gaps, a grid of this resolution encloses more.
constexpr unsigned CoarseResolution = 32;

/// The core of a cluster is what is left after taking off a layer of voxels; or more of them, as
/// long as so much of all is left that is no core: then there is noise.
constexpr double MostPartOfNoise = 0.02;
constexpr int MostLayers = 3;
/// Noise fills the inside of limbs up to a half thickness of so many deviations, its tails included, and a voxel.
constexpr double DeviationsInLimb = 5.;
/// It is told around so many points, by so many others at least, as close as so many voxels.
constexpr std::size_t PointsOfNoise = 200;
constexpr std::size_t LeastPointsOfLayer = 16;
constexpr double VoxelsOfNoise = 2.;
/// ... or, without voxels, as this part of the diagonal.
constexpr double DiagonalOfNoise = 0.02;
/// It has so many voxels, and of the cube around it fills this part: thin sheets and rods do not.
constexpr std::size_t LeastVoxelsOfCore = 6;
constexpr double LeastPartOfCube = 0.15;
/// A cluster reaches farther than the layers that were taken off; stray points, yet farther.
constexpr double ExtraLayers = 2.;
constexpr double Fringe = 1.6;
/// So near its end, in voxels, there are few points of a cluster.
constexpr double RimOfBall = 2.;
/// A cluster touches an open scan if so much of its rim is occupied.
constexpr double RimWidth = 1.5;
constexpr double LeastPartOfRim = 0.03;

constexpr int MostSteps = 200;
constexpr float LeastChangeOfFill = 1e-3f;

/// Lengths in voxels.
struct Ball
{
  Eigen::Vector3d center;
  double radius;
};

Eigen::Vector3d placeOf(const VoxelGrid& grid, std::size_t voxel)
{
  const auto strides = grid.strides();
  const std::size_t x = voxel % strides[1], y = voxel % strides[2] / strides[1];
  const std::size_t z = voxel / strides[2];
  return { double(x), double(y), double(z) };
}

bool isCompact(const VoxelGrid& grid, const std::vector<std::size_t>& core)
{
  Eigen::AlignedBox3d box;
  for (const std::size_t voxel : core)
  {
    box.extend(placeOf(grid, voxel));
  }
  return core.size() >= LeastVoxelsOfCore &&
    double(core.size()) >= LeastPartOfCube * std::pow(box.sizes().maxCoeff() + 1., 3);
}

Ball ballAround(const VoxelGrid& grid, const std::vector<std::size_t>& core, double margin)
{
  Ball ball{ Eigen::Vector3d::Zero(), 0. };
  for (const std::size_t voxel : core)
  {
    ball.center += placeOf(grid, voxel) / double(core.size());
  }
  for (const std::size_t voxel : core)
  {
    ball.radius = std::max(ball.radius, (placeOf(grid, voxel) - ball.center).norm() + margin);
  }
  return ball;
}

/// Calls `use(voxel, distance)` for the voxels at most so far from the centre of a ball, but not for
/// those of the outermost layer.
template <typename Use>
void forEachVoxelAround(const VoxelGrid& grid, const Ball& ball, double radius, Use use)
{
  const auto strides = grid.strides();
  std::array<std::size_t, 3> low, high;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double center = ball.center[Eigen::Index(axis)];
    low[axis] = std::size_t(std::max(1., std::ceil(center - radius)));
    high[axis] = std::min(grid.counts[axis] - 1, std::size_t(center + radius) + 1);
  }
  for (std::size_t z = low[2]; z < high[2]; ++z)
  {
    for (std::size_t y = low[1]; y < high[1]; ++y)
    {
      for (std::size_t x = low[0]; x < high[0]; ++x)
      {
        const double distance =
          (Eigen::Vector3d(double(x), double(y), double(z)) - ball.center).norm();
        if (distance <= radius)
        {
          use(x * strides[0] + y * strides[1] + z * strides[2], distance);
        }
      }
    }
  }
}

bool holds(const Ball& ball, const Ball& other)
{
  return (other.center - ball.center).norm() < ball.radius;
}

/// Standard deviation of the points across the surface, as far as balls of this radius show it.
double noiseOf(const PointCloud& cloud, float radius, const Progress& progress)
{
  const NearestPoints nearest(cloud.points());
  const std::size_t all = cloud.points().size(), asked = std::min(all, PointsOfNoise);
  std::vector<float> scatters;
  std::vector<NearPoint> around, some;
  for (std::size_t i = 0; i < asked && progress(0.); ++i)
  {
    const Vector4 place = cloud.points()[i * all / asked];
    around.clear();
    nearest.forEachWithin(place, radius,
      [&](std::uint32_t index, float squared) {
        around.push_back({ squared, index });
      });
    if (around.size() < LeastPointsOfLayer)
    {
      continue;
    }
    // Many would all lie within the noise.
    const std::size_t count = std::min(around.size(), MostPointsOfLayer);
    some.clear();
    for (std::size_t k = 0; k < count; ++k)
    {
      some.push_back(around[k * around.size() / count]);
    }
    std::sort(some.begin(), some.end());
    scatters.push_back(localLayer(place, cloud.points(), some).scatter);
  }
  return scatters.empty() ? 0. : double(medianOf(std::move(scatters)));
}

/// Those that are compact after `leastLayers` were taken off.
std::vector<Ball> findClusters(const OccupiedVoxels& voxels, int leastLayers = 1)
{
  const double most =
    MostPartOfNoise * double(std::count(voxels.isOccupied.begin(), voxels.isOccupied.end(), 1));
  Voxels cores = voxels.isOccupied;
  std::vector<Ball> clusters;
  double noise = most + 1.;
  // Where clusters touch each other, each has a core of its own some layers farther in.
  for (int layers = 1; layers <= MostLayers && noise > 0.; ++layers)
  {
    if (noise > most)
    {
      clusters.clear();
    }
    growVoxels(voxels.grid, cores, 0);
    if (layers < leastLayers)
    {
      continue;
    }
    noise = 0.;
    for (const auto& core : connectedPieces(voxels.grid, cores))
    {
      const Ball ball = ballAround(voxels.grid, core, layers + ExtraLayers);
      const bool isCluster = isCompact(voxels.grid, core);
      noise += isCluster ? 0. : double(core.size());
      if (isCluster &&
        std::none_of(clusters.begin(), clusters.end(),
          [&](const Ball& cluster) { return holds(cluster, ball); }))
      {
        clusters.push_back(ball);
      }
    }
  }
  return noise <= most ? clusters : std::vector<Ball>();
}

bool touches(const OccupiedVoxels& voxels, const Ball& cluster)
{
  double occupied = 0., all = 0.;
  forEachVoxelAround(voxels.grid, cluster, cluster.radius + RimWidth,
    [&](std::size_t voxel, double distance)
    {
      if (distance > cluster.radius)
      {
        occupied += voxels.isOccupied[voxel];
        all += 1.;
      }
    });
  return occupied > LeastPartOfRim * all;
}

/// Sets the voxels of a kind inside or outside, so that a harmonic function that continues those
/// around them is above or below a half there: the smoothest way on.
void fillSmoothly(const VoxelGrid& grid, Voxels& inside, const Voxels& isHidden)
{
  std::vector<std::size_t> hidden;
  std::vector<float> values(inside.begin(), inside.end());
  for (std::size_t voxel = 0; voxel < isHidden.size(); ++voxel)
  {
    if (isHidden[voxel] != 0)
    {
      hidden.push_back(voxel);
      values[voxel] = 0.5f;
    }
  }
  const auto [sx, sy, sz] = grid.strides();
  float change = 1.f;
  for (int step = 0; step < MostSteps && change > LeastChangeOfFill; ++step)
  {
    change = 0.f;
    for (const std::size_t voxel : hidden)
    {
      const float mean = (values[voxel - sx] + values[voxel + sx] + values[voxel - sy] +
                           values[voxel + sy] + values[voxel - sz] + values[voxel + sz]) /
        6.f;
      change = std::max(change, std::abs(mean - values[voxel]));
      values[voxel] = mean;
    }
  }
  for (const std::size_t voxel : hidden)
  {
    inside[voxel] = std::uint8_t(values[voxel] > 0.5f);
  }
}

/// Whether the grid is fine enough for what the cloud encloses, but not too fine.
bool isEnclosing(const OccupiedSolid& solid, const OccupiedSolid& coarse)
{
  const auto volume = [](const OccupiedSolid& some)
  { return double(some.interiorCount) * std::pow(some.grid.width, 3); };
  return solid.enclosesSomething() && volume(solid) >= volume(coarse);
}

/// The voxels of clusters, but for those near the surface.
Voxels clusterVoxels(
  const PointCloud& cloud, const OccupiedVoxels& voxels, std::vector<Ball> clusters)
{
  OccupiedSolid solid = occupiedSolid(cloud, Resolution);
  const bool isClosed = isEnclosing(solid, occupiedSolid(cloud, CoarseResolution));
  if (!isClosed)
  {
    std::erase_if(clusters, [&](const Ball& cluster) { return touches(voxels, cluster); });
  }
  Voxels isHidden(voxels.isOccupied.size(), 0), isCore = isHidden, isFringe = isHidden;
  for (const Ball& cluster : clusters)
  {
    forEachVoxelAround(voxels.grid, cluster, Fringe * cluster.radius,
      [&](std::size_t voxel, double distance)
      {
        isFringe[voxel] = 1;
        isHidden[voxel] = isHidden[voxel] | std::uint8_t(distance <= cluster.radius);
        isCore[voxel] = isCore[voxel] | std::uint8_t(distance <= cluster.radius - RimOfBall);
      });
  }
  fillSmoothly(solid.grid, solid.inside, isHidden);
  dropSmallPieces(solid.grid, solid.inside);
  Voxels isNear = solid.inside, isDeep = solid.inside;
  growVoxels(solid.grid, isNear, 1);
  growVoxels(solid.grid, isDeep, 0);
  Voxels isDeeper = isDeep;
  growVoxels(solid.grid, isDeeper, 0);
  // In the middle of a cluster only what lies on the surface stays; near its end there are few points
  // of it, and those of the surface should stay, even if it is not quite where it seems to be.
  for (std::size_t voxel = 0; voxel < isHidden.size(); ++voxel)
  {
    const bool isOut = isCore[voxel] != 0 ? !solid.inside[voxel] : !isNear[voxel];
    const bool isIn = isCore[voxel] != 0 ? isDeep[voxel] != 0 : isDeeper[voxel] != 0;
    isHidden[voxel] =
      std::uint8_t((isFringe[voxel] != 0 && isOut) || (isHidden[voxel] != 0 && isIn));
  }
  return isHidden;
}

/// Else the clusters are what was scanned.
bool isMostOf(const PointCloud& cloud, const PointCloud& rest)
{
  return double(rest.points().size()) >= (1. - MostPartOfClusters) * double(cloud.points().size());
}

/// Without clusters that may touch the surface; nothing if there are none.
std::optional<PointCloud> withoutThickParts(
  const PointCloud& cloud, const Progress& progress, const Executor& executor)
{
  const OccupiedVoxels voxels = occupiedVoxels(cloud, Resolution, executor);
  std::vector<Ball> clusters = progress(0.) ? findClusters(voxels) : std::vector<Ball>();
  if (!clusters.empty())
  {
    // What may be a limb that is full of noise is none.
    const int layersOfLimb = int(DeviationsInLimb *
      noiseOf(cloud, float(VoxelsOfNoise * voxels.grid.width), progress) / voxels.grid.width);
    clusters = layersOfLimb > 0 ? findClusters(voxels, layersOfLimb + 1) : clusters;
  }
  if (clusters.empty() || !progress(0.))
  {
    return {};
  }
  const Voxels isLeftOut = clusterVoxels(cloud, voxels, clusters);
  PointCloud rest = cloud.without(
    [&](Vector4 point)
    {
      const std::size_t voxel = voxels.grid.voxelAt(point.toDouble());
      return voxel < isLeftOut.size() && isLeftOut[voxel] != 0;
    });
  return isMostOf(cloud, rest) ? std::move(rest) : std::optional<PointCloud>();
}
}

std::optional<PointCloud> withoutClusters(
  const PointCloud& cloud, const Progress& progress, const Executor& executor)
{
  if (!cloud.hasExtent())
  {
    return {};
  }
  bool goesOn = true;
  const Progress ask = [&](double fraction) { return goesOn = goesOn && progress(fraction); };
  const SeparateClusters separate(
    cloud, [&] { return noiseOf(cloud, float(DiagonalOfNoise * cloud.diagonal()), ask); }, ask,
    executor);
  std::optional<PointCloud> rest;
  if (!separate.areNone())
  {
    PointCloud without = cloud.without([&](Vector4 point) { return separate.hold(point); });
    if (isMostOf(cloud, without))
    {
      rest = std::move(without);
    }
  }
  std::optional<PointCloud> more =
    ask(0.) ? withoutThickParts(rest ? *rest : cloud, ask, executor) : std::nullopt;
  if (!goesOn)
  {
    return {};
  }
  return more && isMostOf(cloud, *more) ? std::move(more) : std::move(rest);
}
}
