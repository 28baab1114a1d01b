// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CloudGenerator.h"

#include "cloud/Visibility.h"
#include "mesh/SurfaceSampler.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neuralmesh
{
namespace
{
enum Stream : std::uint64_t
{
  SurfaceStream = 1,
  HoleStream,
  NoiseStream,
  OutlierStream
};

/// Standard normal, by the method of Box and Muller.
double gaussian(Random& random)
{
  const double radius = std::sqrt(-2. * std::log(1. - random.uniform()));
  return radius * std::cos(2. * std::numbers::pi * random.uniform());
}

void shuffle(std::vector<Eigen::Vector3d>& points, Random& random)
{
  for (std::size_t left = points.size(); left > 1; --left)
  {
    std::swap(points[left - 1], points[random.below(std::uint32_t(left))]);
  }
}

using Cloud = std::vector<Eigen::Vector3d>;

/// Progress is told once in so many points.
constexpr std::size_t PointsBetweenReports = 4096;
/// How much of the whole is done when points are drawn, and when those out of sight are gone.
constexpr double EndOfDrawing = 0.3;
constexpr double EndOfSight = 0.9;

/// Those of the triangles; points without one do not count.
Eigen::AlignedBox3d boundsOf(const TriangleMesh& surface)
{
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      box.extend(surface.points[corner]);
    }
  }
  return box;
}

/// Draws points until there are as many as asked for. Returns false if it is ended early.
bool drawPoints(const SurfaceSampler& sampler, const Eigen::AlignedBox3d& box,
  const CloudOptions& options, Cloud& cloud, const Progress& progress)
{
  Random random(options.seed, SurfaceStream);
  const auto axis = Eigen::Index(options.gradientAxis);
  const double extent = box.sizes()[axis];
  cloud.reserve(options.count);
  while (cloud.size() < options.count)
  {
    if (cloud.size() % PointsBetweenReports == 0 &&
      !progress(double(cloud.size()) / double(options.count)))
    {
      return false;
    }
    const Eigen::Vector3d point = sampler.draw(random).point;
    const double along = extent > 0. ? (point[axis] - box.min()[axis]) / extent : 0.;
    if (options.gradient <= 1. || random.uniform() < std::pow(options.gradient, -along))
    {
      cloud.push_back(point);
    }
  }
  return true;
}

/// Takes away the points for which `isGone` holds. Returns false if it is ended early.
template <typename IsGone>
bool takeAway(Cloud& cloud, const IsGone& isGone, const Progress& progress)
{
  std::size_t done = 0;
  bool goesOn = true;
  std::erase_if(cloud,
    [&](const Eigen::Vector3d& point)
    {
      if (done++ % PointsBetweenReports == 0)
      {
        goesOn = goesOn && progress(double(done) / double(cloud.size()));
      }
      return goesOn && isGone(point);
    });
  return goesOn;
}

bool takeUnseen(const TriangleMesh& surface, const Eigen::Vector3d& viewpoint, Cloud& cloud,
  const Progress& progress)
{
  const Visibility visibility(surface);
  return takeAway(
    cloud, [&](const Eigen::Vector3d& point) { return !visibility.isSeen(point, viewpoint); },
    progress);
}

bool cutHoles(const CloudOptions& options, double diagonal, Cloud& cloud, const Progress& progress)
{
  Random random(options.seed, HoleStream);
  Cloud centers;
  for (unsigned hole = 0; hole < options.holes && !cloud.empty(); ++hole)
  {
    centers.push_back(cloud[random.below(std::uint32_t(cloud.size()))]);
  }
  const auto isInHole = [&](const Eigen::Vector3d& point)
  {
    return std::any_of(centers.begin(), centers.end(),
      [&](const Eigen::Vector3d& center)
      { return (point - center).norm() <= options.holeRadius * diagonal; });
  };
  return takeAway(cloud, isInHole, progress);
}

void addNoise(const CloudOptions& options, double diagonal, Cloud& cloud)
{
  Random random(options.seed, NoiseStream);
  for (Eigen::Vector3d& point : cloud)
  {
    for (int k = 0; k < 3; ++k)
    {
      point[k] += options.noise * diagonal * gaussian(random);
    }
  }
}

void addOutliers(const CloudOptions& options, const Eigen::AlignedBox3d& box, Cloud& cloud)
{
  Random random(options.seed, OutlierStream);
  const auto count = std::size_t(std::llround(options.outliers * double(cloud.size())));
  for (std::size_t i = 0; i < count; ++i)
  {
    Eigen::Vector3d fractions;
    for (int k = 0; k < 3; ++k)
    {
      fractions[k] = random.uniform();
    }
    cloud.push_back(box.min() + fractions.cwiseProduct(box.sizes()));
  }
  if (count > 0)
  {
    shuffle(cloud, random);
  }
}
}

std::vector<Eigen::Vector3d> generateCloud(
  const TriangleMesh& surface, const CloudOptions& options, const Progress& progress)
{
  const SurfaceSampler sampler(surface);
  if (!sampler.hasArea())
  {
    return {};
  }
  const Eigen::AlignedBox3d box = boundsOf(surface);
  const double diagonal = box.diagonal().norm();
  Cloud cloud;
  const bool isWhole =
    drawPoints(sampler, box, options, cloud, partOf(progress, 0., EndOfDrawing)) &&
    (!options.viewpoint ||
      takeUnseen(surface, *options.viewpoint, cloud, partOf(progress, EndOfDrawing, EndOfSight))) &&
    cutHoles(options, diagonal, cloud, partOf(progress, EndOfSight, 1.));
  if (!isWhole)
  {
    return {};
  }
  if (options.noise > 0.)
  {
    addNoise(options, diagonal, cloud);
  }
  addOutliers(options, box, cloud);
  return cloud;
}
}
