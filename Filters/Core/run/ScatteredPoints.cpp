// SPDX-License-Identifier: BSD-3-Clause
#include "run/ScatteredPoints.h"

#include "cloud/NearestPoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr std::size_t CentersAsked = 200;
/// More would cost more, and tell the same.
constexpr std::size_t MostPointsOfBalls = 200000;
/// Of fewer the smallest ball holds a large part, and tells nothing.
constexpr std::size_t FewestPointsThatTell = 200;
/// In the smallest ball that is looked at.
constexpr std::size_t PointsInBall = 16;
constexpr float GrowthOfBall = 1.5f;
/// The ball to either side is so many radii away, and not farther than this part of the size of the cloud.
constexpr float RadiiAway = 1.f / 0.7f;
constexpr float FarthestAway = 0.07f;
/// What has less than this part of the points in the middle is empty.
constexpr double MostInEmpty = 0.35;
/// Balls move to where their points are so often: onto the surface, if there is one.
constexpr int MovesToMiddle = 3;

/// Along the edges, the diagonals of the sides, and those of a cube.
std::array<Vector4, 13> axesOfCube()
{
  std::array<Vector4, 13> axes;
  std::size_t count = 0;
  for (int i = 14; i < 27; ++i)
  {
    const Eigen::Vector3d axis =
      Eigen::Vector3i(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1).cast<double>();
    axes[count] = Vector4(Eigen::Vector3d(axis.normalized()));
    ++count;
  }
  return axes;
}

struct BallOfPoints
{
  std::size_t count = 0;
  Vector4 middle;
};

BallOfPoints ballAt(const NearestPoints& nearest, Vector4 center, float radius)
{
  BallOfPoints ball;
  Vector4 sum;
  nearest.forEachWithin(center, radius,
    [&](std::uint32_t index, float)
    {
      sum += nearest.points()[index] - center;
      ++ball.count;
    });
  ball.middle = center + (ball.count > 0 ? 1.f / float(ball.count) * sum : Vector4());
  return ball;
}

/// Whether there is an axis with few points to either side.
bool isFlat(const NearestPoints& nearest, Vector4 center, float radius)
{
  static const std::array<Vector4, 13> Axes = axesOfCube();
  for (int move = 0; move < MovesToMiddle; ++move)
  {
    center = ballAt(nearest, center, radius).middle;
  }
  const double most = MostInEmpty * double(ballAt(nearest, center, radius).count);
  return std::any_of(Axes.begin(), Axes.end(),
    [&](Vector4 axis)
    {
      const Vector4 away = RadiiAway * radius * axis;
      return double(ballAt(nearest, center + away, radius).count) <= most &&
        double(ballAt(nearest, center - away, radius).count) <= most;
    });
}

bool isScattered(const NearestPoints& nearest, Vector4 center)
{
  std::array<NearPoint, PointsInBall> near;
  const std::size_t found = nearest.find(center, near);
  // Many on one spot: one look from there.
  float radius = found == PointsInBall ? std::sqrt(near.back().squaredDistance) : 0.f;
  radius = radius > 0.f ? radius : FarthestAway / RadiiAway;
  do
  {
    if (isFlat(nearest, center, radius))
    {
      return false;
    }
    radius *= GrowthOfBall;
  } while (RadiiAway * radius <= FarthestAway);
  return true;
}
}

double scatteredShare(const PointCloud& cloud, const Executor& executor)
{
  const std::size_t all = cloud.points().size();
  if (all < FewestPointsThatTell)
  {
    return 0.;
  }
  std::vector<Vector4> points(std::min(all, MostPointsOfBalls));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = cloud.points()[i * all / points.size()];
  }
  const NearestPoints nearest(points, executor);
  const std::size_t asked = std::min(points.size(), CentersAsked);
  return executor.sum(asked, 1,
           [&](std::size_t i)
           { return isScattered(nearest, points[i * points.size() / asked]) ? 1. : 0.; }) /
    double(asked);
}
}
