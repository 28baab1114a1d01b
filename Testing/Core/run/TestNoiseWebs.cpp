// SPDX-License-Identifier: BSD-3-Clause
// Promise: where noise has filled a hole or a gap, the web is told with its place and points; what is as thin but no
// web, and what is as hollow but thicker than the noise, is not.
#include "run/NoiseWebs.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "PointMeasures.h"
#include "run/Reconstruction.h"
#include "run/Warnings.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

namespace neuralmesh::testing
{
namespace
{
/// A ball whose heights are multiplied by what `height` tells of the distance from the axis.
TriangleMesh lens(unsigned resolution, const std::function<double(double)>& height)
{
  TriangleMesh mesh = makeSphere(resolution);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point[2] *= height(std::hypot(point[0], point[1]));
  }
  return mesh;
}

/// So thick in the middle, and some 1.5 thick around.
TriangleMesh biconcave(double thickness, unsigned resolution = 40)
{
  return lens(
    resolution, [thickness](double radius) { return 0.5 * thickness + 2. * radius * radius; });
}

/// The lens with points of it that have this noise.
struct NoisyLens
{
  NoisyLens(const TriangleMesh& shape, double noise)
  {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& point : shape.points)
    {
      box.extend(point);
    }
    CloudOptions options;
    options.count = 100000;
    options.noise = noise / box.diagonal().norm();
    cloud.emplace(generateCloud(shape, options));
    const Mesh mesh = buildMesh(shape, *cloud);
    result.support = supportOf(mesh, *cloud, options.count);
    result.noiseWebs = findNoiseWebs(mesh, result.support, *cloud);
  }

  /// The warnings of webs.
  std::vector<std::string> warnings() const
  {
    std::vector<std::string> all = warningsOf(result, *cloud);
    std::erase_if(
      all, [](const std::string& warning) { return !warning.ends_with("[finer-than-noise]"); });
    return all;
  }

  std::optional<PointCloud> cloud;
  Reconstruction result;
};

constexpr double NoiseOfLens = 0.05;
}

TEST(NoiseWebs, InHollows)
{
  // With edges of one deviation of the noise, and of half of it.
  for (const unsigned resolution : { 40u, 80u })
  {
    const TriangleMesh shape = biconcave(0.5 * NoiseOfLens, resolution);
    const NoisyLens lens(shape, NoiseOfLens);
    ASSERT_EQ(lens.result.noiseWebs.size(), 1u);
    const NoiseWeb& web = lens.result.noiseWebs[0];
    EXPECT_LT(web.place.norm(), NoiseOfLens);
    // Both sides are thin to where they rise above some two deviations of the noise: within a radius of 0.15.
    const auto near = double(std::count_if(lens.cloud->points().begin(), lens.cloud->points().end(),
      [&](Vector4 point) { return lens.cloud->toInput(point).norm() < 3. * NoiseOfLens; }));
    EXPECT_GT(web.points, 0.1 * near);
    EXPECT_LT(web.points, near);
    ASSERT_EQ(lens.warnings().size(), 1u);
    EXPECT_NE(lens.warnings()[0].find("around ("), std::string::npos);
  }
}

TEST(NoiseWebs, ThickerThanNoise)
{
  EXPECT_TRUE(NoisyLens(biconcave(5. * NoiseOfLens), NoiseOfLens).warnings().empty());
}

TEST(NoiseWebs, ThinPartIsNone)
{
  // A plate with a round rim, as thin as the web.
  const TriangleMesh plate = lens(40, [](double) { return NoiseOfLens; });
  EXPECT_TRUE(NoisyLens(plate, NoiseOfLens).warnings().empty());
}

TEST(NoiseWebs, SingleVertexIsChance)
{
  NoisyLens lens(biconcave(0.5 * NoiseOfLens), NoiseOfLens);
  lens.result.noiseWebs[0].vertices = 1;
  EXPECT_TRUE(lens.warnings().empty());
}
}
