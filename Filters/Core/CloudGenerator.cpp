// SPDX-License-Identifier: BSD-3-Clause
#include "CloudGenerator.h"

#include "SurfaceSampler.h"

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
}

std::vector<Eigen::Vector3d> generateCloud(const TriangleMesh& surface, const CloudOptions& options)
{
  std::vector<Eigen::Vector3d> cloud;
  const SurfaceSampler sampler(surface);
  if (!sampler.hasArea())
  {
    return cloud;
  }
  Eigen::AlignedBox3d box;
  for (const auto& triangle : surface.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      box.extend(surface.points[corner]);
    }
  }
  const double diagonal = box.diagonal().norm();

  Random surfaceRandom(options.seed, SurfaceStream);
  const auto axis = Eigen::Index(options.gradientAxis);
  const double extent = box.sizes()[axis];
  cloud.reserve(options.count);
  while (cloud.size() < options.count)
  {
    const Eigen::Vector3d point = sampler.draw(surfaceRandom).point;
    const double along = extent > 0. ? (point[axis] - box.min()[axis]) / extent : 0.;
    if (options.gradient <= 1. || surfaceRandom.uniform() < std::pow(options.gradient, -along))
    {
      cloud.push_back(point);
    }
  }

  Random holeRandom(options.seed, HoleStream);
  std::vector<Eigen::Vector3d> centers;
  for (unsigned hole = 0; hole < options.holes && !cloud.empty(); ++hole)
  {
    centers.push_back(cloud[holeRandom.below(std::uint32_t(cloud.size()))]);
  }
  std::erase_if(cloud,
    [&](const Eigen::Vector3d& point)
    {
      return std::any_of(centers.begin(), centers.end(),
        [&](const Eigen::Vector3d& center)
        { return (point - center).norm() <= options.holeRadius * diagonal; });
    });

  if (options.noise > 0.)
  {
    Random noiseRandom(options.seed, NoiseStream);
    for (Eigen::Vector3d& point : cloud)
    {
      for (int k = 0; k < 3; ++k)
      {
        point[k] += options.noise * diagonal * gaussian(noiseRandom);
      }
    }
  }

  Random outlierRandom(options.seed, OutlierStream);
  const auto outlierCount = std::size_t(std::llround(options.outliers * double(cloud.size())));
  for (std::size_t i = 0; i < outlierCount; ++i)
  {
    Eigen::Vector3d fractions;
    for (int k = 0; k < 3; ++k)
    {
      fractions[k] = outlierRandom.uniform();
    }
    cloud.push_back(box.min() + fractions.cwiseProduct(box.sizes()));
  }
  if (outlierCount > 0)
  {
    shuffle(cloud, outlierRandom);
  }
  return cloud;
}
}
