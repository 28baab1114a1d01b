// SPDX-License-Identifier: BSD-3-Clause
#include "fit/MeshQuality.h"

#include "cloud/MeshBuilder.h"
#include "run/Reconstruction.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// The residual is the distance between points and mesh, in the units of the input.
TEST(MeshQuality, Residual)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  for (Eigen::Vector3d& point : points)
  {
    point = 100. * 1.01 * point.normalized();
  }
  const PointCloud cloud(points);
  TriangleMesh triangles = makeSphere(64);
  for (Eigen::Vector3d& point : triangles.points)
  {
    point *= 100.;
  }
  const Mesh mesh = buildMesh(triangles, cloud);
  const MeshQuality quality = *measureQuality(cloud, mesh, triangles);
  EXPECT_NEAR(quality.residual, 1., 0.05);
  EXPECT_EQ(quality.outlierShare, 0.);
  EXPECT_EQ(quality.surface.components, 1u);
  EXPECT_EQ(quality.surface.genus, 0);
}

// Outliers are counted, and do not count for the residual.
TEST(MeshQuality, Outliers)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  for (std::size_t i = 0; i < points.size(); i += 10)
  {
    points[i] *= 1.5;
  }
  const PointCloud cloud(points);
  const TriangleMesh triangles = makeSphere(32);
  const MeshQuality quality = *measureQuality(cloud, buildMesh(triangles, cloud), triangles);
  EXPECT_NEAR(quality.outlierShare, 0.1, 0.03);
  EXPECT_LT(quality.residual, 0.01);
}

// After a run, points that the fit did not see are as far from the mesh as the noise has them.
TEST(MeshQuality, HeldOutPoints)
{
  CloudOptions options;
  options.noise = 0.005;
  const PointCloud cloud(sphereCloud(options));
  Parameters parameters;
  parameters.numberOfVertices = 1000;
  const Reconstruction result = reconstruct(cloud, parameters, goOn);
  ASSERT_TRUE(result.quality && result.finish);
  const double noise = options.noise * SphereDiagonal;
  EXPECT_NEAR(result.quality->residual, noise, 0.1 * noise);
  EXPECT_NEAR(result.finish->noise * cloud.unit(), noise, 0.1 * noise);
}

// A cloud of so few points that none is held out is measured with all.
TEST(MeshQuality, FewPoints)
{
  const std::vector<Eigen::Vector3d> points(makeCube().points);
  const PointCloud cloud(points);
  const TriangleMesh triangles = makeCube();
  EXPECT_NEAR(measureQuality(cloud, buildMesh(triangles, cloud), triangles)->residual, 0., 1e-6);
}
}
