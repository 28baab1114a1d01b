// SPDX-License-Identifier: BSD-3-Clause
#include "start/SeparateClusters.h"

#include "cloud/NearestPoints.h"
#include "start/VoxelCounts.h"
#include "start/VoxelNeighbors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace neuralmesh
{
namespace
{
/// Along the diagonal of the cloud: what is closer than a voxel is not apart.
constexpr double VoxelsAlongDiagonal = 100.;
constexpr std::size_t EmptyLayersAround = 2;
/// Stray points are alone in a voxel and those that touch it; with so many there is more.
constexpr std::uint32_t FewestTogether = 4;
/// Of fewer points chance makes any shape.
constexpr std::size_t FewestInGroup = 64;
/// What has more than this part of all points is a part of the scan, whatever it is.
constexpr double MostPartOfGroup = 0.05;
/// A scan of more groups consists of them.
constexpr std::size_t MostGroups = 1000;

/// More would tell the same.
constexpr std::size_t MostPointsAsked = 1024;
constexpr std::size_t CentersOfGroup = 64;
constexpr std::size_t NeighborsAtFirst = 8;
/// Of the variance of the nearest points, the part across the plane that fits them best, on average. In space it is 0.1
/// or more for eight of them and grows with their number; on a surface it falls to 0.06 or less at some scale.
constexpr double LeastVariation = 0.09;
/// Of all points of a group: what was strewn around a place is nearly as thick as wide, a tree or a pile is not.
constexpr double LeastVariationOfAll = 0.18;
/// Standard deviation over mean of distances from the middle, in deviations of the points: 0.42 of a normal distribution,
/// 0.26 of an even one in a ball, 0.14 on a cube, 0 on a ball.
constexpr double LeastSpread = 0.23;
/// The noise of a small body spreads them more, but leaves a hollow: in deviations of the points from the middle, they are
/// less dense within the first radius than between both, by so many deviations of chance. The larger one lies within
/// an even cube, too.
constexpr double RadiusOfHollow = 1., RadiusAroundHollow = 1.7;
constexpr double DeviationsOfHollow = 3.;
/// The same body under noise lies on no surface up to a radius of five deviations of the noise: then this is the
/// standard deviation of its points, in those of the noise.
constexpr double DeviationsInBody = 3.05;
/// Around the middle of a group, so many of its radii have strewn points.
constexpr double RadiiOfFringe = 1.6;

/// A part for the executor.
constexpr std::size_t PointsOfBox = 65536;

constexpr std::uint32_t NoGroup = std::numeric_limits<std::uint32_t>::max();

struct GroupMoments
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d variances =
    Eigen::Vector3d::Zero(); ///< along the principal axes, the least first
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

  double variation() const { return variances.sum() > 0. ? variances[0] / variances.sum() : 0.; }
};

template <typename PointAt>
GroupMoments momentsOf(std::size_t count, const PointAt& pointAt)
{
  GroupMoments result;
  for (std::size_t i = 0; i < count; ++i)
  {
    result.mean += pointAt(i).toDouble() / double(count);
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3d offset = pointAt(i).toDouble() - result.mean;
    covariance += offset * offset.transpose() / double(count);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  result.variances = solver.eigenvalues();
  result.axes = solver.eigenvectors();
  return result;
}

GroupMoments momentsOf(std::span<const Vector4> points)
{
  return momentsOf(points.size(), [&](std::size_t i) { return points[i]; });
}

/// Whether there are as many points in the middle as farther out, but for chance.
bool fillTheMiddle(std::span<const Vector4> points, const GroupMoments& moments)
{
  double sum = 0., squares = 0., inHollow = 0., inBoth = 0.;
  for (const Vector4 point : points)
  {
    const Eigen::Vector3d offset = moments.axes.transpose() * (point.toDouble() - moments.mean);
    const double squared = offset.cwiseAbs2().cwiseQuotient(moments.variances).sum();
    sum += std::sqrt(squared);
    squares += squared;
    inHollow += squared < RadiusOfHollow * RadiusOfHollow ? 1. : 0.;
    inBoth += squared < RadiusAroundHollow * RadiusAroundHollow ? 1. : 0.;
  }
  const double mean = sum / double(points.size());
  const double part = std::pow(RadiusOfHollow / RadiusAroundHollow, 3);
  const bool isHollow =
    inHollow < part * inBoth - DeviationsOfHollow * std::sqrt(part * (1. - part) * inBoth);
  return !isHollow &&
    squares / double(points.size()) - mean * mean >= LeastSpread * LeastSpread * mean * mean;
}

/// Mean variation around some of the points.
double variationOfNearest(const NearestPoints& nearest, std::size_t neighbors)
{
  const std::span<const Vector4> points = nearest.points();
  const std::size_t asked = std::min(points.size(), CentersOfGroup);
  std::vector<NearPoint> near(neighbors);
  double sum = 0.;
  for (std::size_t i = 0; i < asked; ++i)
  {
    const std::size_t found = nearest.find(points[i * points.size() / asked], near);
    sum += momentsOf(found, [&](std::size_t k) { return points[near[k].index]; }).variation();
  }
  return sum / double(asked);
}

std::vector<Vector4> somePoints(std::span<const Vector4> points)
{
  std::vector<Vector4> some(std::min(points.size(), MostPointsAsked));
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    some[i] = points[i * points.size() / some.size()];
  }
  return some;
}

/// All points are in it, and none in its outermost layers.
VoxelGrid gridOfAll(const PointCloud& cloud, const Executor& executor)
{
  const std::span<const Vector4> points = cloud.points();
  std::vector<Eigen::AlignedBox3d> boxes((points.size() + PointsOfBox - 1) / PointsOfBox);
  executor.forEachRange(points.size(), PointsOfBox,
    [&](std::size_t begin, std::size_t end)
    {
      for (const Vector4 point : points.subspan(begin, end - begin))
      {
        boxes[begin / PointsOfBox].extend(point.toDouble());
      }
    });
  Eigen::AlignedBox3d box;
  for (const Eigen::AlignedBox3d& part : boxes)
  {
    box.extend(part);
  }
  VoxelGrid grid;
  grid.width = box.diagonal().norm() / VoxelsAlongDiagonal;
  grid.first = box.min() - Eigen::Vector3d::Constant(double(EmptyLayersAround) * grid.width);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double side = box.sizes()[Eigen::Index(axis)] / grid.width;
    grid.counts[axis] = std::size_t(std::ceil(side)) + 1 + 2 * EmptyLayersAround;
  }
  return grid;
}

/// Finds groups of points that are apart, and those of them that are clusters.
class GroupSearch
{
public:
  GroupSearch(const PointCloud& cloud, const Executor& executor)
    : cloud_(cloud)
    , grid_(gridOfAll(cloud, executor))
    , counts_(countsInVoxels(
        cloud.points(), grid_.size(), [this](Vector4 point) { return voxelOf(point); }, executor))
    , groupOf_(grid_.size(), NoGroup)
  {
    findGroups();
  }

  const VoxelGrid& grid() const { return grid_; }

  std::vector<std::uint8_t> leftOut(const std::function<double()>& noise, const Progress& progress)
  {
    std::vector<std::uint8_t> result;
    std::optional<double> least;
    std::size_t leftOut = 0;
    for (const std::vector<Vector4>& points : pointsOfGroups())
    {
      if (!progress(0.))
      {
        return {};
      }
      const std::vector<Vector4> some = somePoints(points);
      if (!areScattered(some))
      {
        continue;
      }
      const GroupMoments moments = momentsOf(some);
      if (!least)
      {
        least = DeviationsInBody * noise();
      }
      if (moments.variances[0] > *least * *least)
      {
        result.resize(grid_.size(), 0);
        leaveOut(points, moments.mean, result);
        leftOut += points.size();
        if (double(leftOut) > MostPartOfClusters * double(cloud_.points().size()))
        {
          return {};
        }
      }
    }
    return result;
  }

private:
  std::size_t voxelOf(Vector4 point) const { return grid_.voxelAt(point.toDouble()); }

  /// Of voxels with several points in them and around them.
  void findGroups()
  {
    std::vector<std::uint8_t> areTogether(grid_.size(), 0);
    for (std::size_t voxel = 0; voxel < counts_.size(); ++voxel)
    {
      if (counts_[voxel] > 0)
      {
        std::uint32_t count = counts_[voxel];
        forEachNeighbor(grid_, voxel, [&](std::size_t other) { count += counts_[other]; });
        areTogether[voxel] = std::uint8_t(count >= FewestTogether);
      }
    }
    const double most = MostPartOfGroup * double(cloud_.points().size());
    const auto pieces = connectedPieces(grid_, std::move(areTogether));
    for (const std::vector<std::size_t>& piece : pieces)
    {
      std::size_t count = 0;
      for (const std::size_t voxel : piece)
      {
        count += counts_[voxel];
      }
      const bool isSmall = count >= FewestInGroup && double(count) <= most;
      groups_ += isSmall ? 1 : 0;
      for (const std::size_t voxel : piece)
      {
        groupOf_[voxel] = isSmall ? std::uint32_t(groups_) : 0;
      }
    }
  }

  /// Of the small ones.
  std::vector<std::vector<Vector4>> pointsOfGroups() const
  {
    if (groups_ > MostGroups)
    {
      return {};
    }
    std::vector<std::vector<Vector4>> result(groups_);
    if (groups_ > 0)
    {
      for (const Vector4 point : cloud_.points())
      {
        const std::uint32_t group = groupOf_[voxelOf(point)];
        if (group != NoGroup && group > 0)
        {
          result[group - 1].push_back(point);
        }
      }
    }
    return result;
  }

  /// The voxels of a group, and those around it that belong to no other and touch none.
  void leaveOut(const std::vector<Vector4>& points, const Eigen::Vector3d& middle,
    std::vector<std::uint8_t>& result) const
  {
    double radius = 0.;
    for (const Vector4 point : points)
    {
      radius = std::max(radius, (point.toDouble() - middle).norm());
    }
    const std::uint32_t group = groupOf_[voxelOf(points.front())];
    const double fringe = RadiiOfFringe * radius + grid_.width;
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(fringe);
    const std::array<std::size_t, 3> low = placeOf(middle - reach), high = placeOf(middle + reach);
    for (std::size_t z = low[2]; z <= high[2]; ++z)
    {
      for (std::size_t y = low[1]; y <= high[1]; ++y)
      {
        for (std::size_t x = low[0]; x <= high[0]; ++x)
        {
          const std::size_t voxel = x + grid_.counts[0] * (y + grid_.counts[1] * z);
          if (counts_[voxel] > 0 && (grid_.center(x, y, z) - middle).norm() <= fringe &&
            !isOfOther(voxel, group))
          {
            result[voxel] = 1;
          }
        }
      }
    }
  }

  /// Of the voxel of the grid that is closest to a point.
  std::array<std::size_t, 3> placeOf(const Eigen::Vector3d& point) const
  {
    std::array<std::size_t, 3> place;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto a = Eigen::Index(axis);
      place[axis] = std::size_t(std::clamp(
        std::round((point[a] - grid_.first[a]) / grid_.width), 0., double(grid_.counts[axis] - 1)));
    }
    return place;
  }

  bool isOfOther(std::size_t voxel, std::uint32_t group) const
  {
    bool touches = false;
    forEachNeighbor(grid_, voxel,
      [&](std::size_t other)
      { touches = touches || (groupOf_[other] != NoGroup && groupOf_[other] != group); });
    return groupOf_[voxel] != group && (groupOf_[voxel] != NoGroup || touches);
  }

  const PointCloud& cloud_;
  VoxelGrid grid_;
  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> groupOf_; ///< 0 is any that is not small
  std::size_t groups_ = 0;
};
}

bool areScattered(std::span<const Vector4> points)
{
  if (points.size() < FewestInGroup)
  {
    return false;
  }
  const GroupMoments moments = momentsOf(points);
  if (moments.variation() < LeastVariationOfAll || !fillTheMiddle(points, moments))
  {
    return false;
  }
  const NearestPoints nearest(points);
  for (std::size_t neighbors = NeighborsAtFirst; neighbors < points.size(); neighbors *= 2)
  {
    if (variationOfNearest(nearest, neighbors) < LeastVariation)
    {
      return false;
    }
  }
  return true;
}

SeparateClusters::SeparateClusters(const PointCloud& cloud, const std::function<double()>& noise,
  const Progress& progress, const Executor& executor)
{
  GroupSearch search(cloud, executor);
  isLeftOut_ = search.leftOut(noise, progress);
  grid_ = search.grid();
}

bool SeparateClusters::hold(Vector4 point) const
{
  return !areNone() && isLeftOut_[grid_.voxelAt(point.toDouble())] != 0;
}
}
