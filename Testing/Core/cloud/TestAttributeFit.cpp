// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/AttributeFit.h"

#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
using Fitted = AttributeFit::Values;

/// The values that a fit gives to the vertices, for points that get theirs by place and index.
template <typename ValuesAt>
std::vector<Fitted> fitted(const PointCloud& cloud, const Mesh& mesh, ValuesAt valuesAt)
{
  const CloudPlaces places(cloud, mesh, goOn);
  AttributeFit fit(mesh);
  places.forEach([&](std::size_t point, const CloudPlaces::Corners& corners)
    { fit.add(corners, 1., valuesAt(cloud.points()[point], point)); });
  return fit.solve();
}

Mesh sphere(const PointCloud& cloud, unsigned resolution = 16)
{
  return buildMesh(makeSphere(resolution), cloud);
}
}

// A linear field of the coordinates comes out as it is, to a tenth of an edge or so (0.03 long).
TEST(AttributeFit, LinearField)
{
  const Mesh mesh = sphere(cleanSphere());
  const auto linear = [](Vector4 p)
  { return Fitted(double(p[0]), double(p[1]), double(p[2]), 3. * double(p[0]) - double(p[2])); };
  const std::vector<Fitted> values =
    fitted(cleanSphere(), mesh, [&](Vector4 p, std::size_t) { return linear(p); });
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_LT((values[v] - linear(mesh.position(v))).abs().maxCoeff(), 0.004) << "vertex " << v;
  }
}

// A value that all points have is that of all vertices.
TEST(AttributeFit, Constant)
{
  const Mesh mesh = sphere(cleanSphere());
  for (const Fitted& value :
    fitted(cleanSphere(), mesh, [](Vector4, std::size_t) { return Fitted(0., 1., -5., 1e-9); }))
  {
    EXPECT_EQ(value[0], 0.);
    EXPECT_NEAR(value[1], 1., 1e-5);
    EXPECT_NEAR(value[2], -5., 5e-5);
    EXPECT_NEAR(value[3], 1e-9, 1e-14);
  }
}

// Noise of the values is averaged out; 26 points lie around a vertex here.
TEST(AttributeFit, AveragesNoise)
{
  const Mesh mesh = sphere(cleanSphere());
  Random random(3);
  const std::vector<Fitted> values = fitted(cleanSphere(), mesh,
    [&](Vector4, std::size_t) { return Fitted::Constant(random.uniform() < 0.5 ? -1. : 1.); });
  double squares = 0.;
  for (const Fitted& value : values)
  {
    squares += value[0] * value[0];
  }
  EXPECT_LT(std::sqrt(squares / double(values.size())), 0.35);
}

// Where there are no points, values go on evenly from those around.
TEST(AttributeFit, FillsGaps)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  std::erase_if(points, [](const Eigen::Vector3d& p) { return p.x() > 0.8; });
  const PointCloud cloud(points);
  const Mesh mesh = sphere(cloud);
  const std::vector<Fitted> values =
    fitted(cloud, mesh, [](Vector4 p, std::size_t) { return Fitted::Constant(double(p[1])); });
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_NEAR(values[v][0], double(mesh.position(v)[1]), 0.02) << "vertex " << v;
  }
}

// Points far from the mesh do not count.
TEST(AttributeFit, PassesOutliersOver)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  const std::size_t inliers = points.size();
  for (std::size_t i = 0; i < 500; ++i)
  {
    points.emplace_back(1.5 * points[i]);
  }
  const PointCloud cloud(points, {}, true);
  const Mesh mesh = sphere(cloud);
  const std::vector<Fitted> values = fitted(cloud, mesh,
    [&](Vector4, std::size_t i)
    { return Fitted::Constant(cloud.origins()[i] < inliers ? 0. : 100.); });
  for (const Fitted& value : values)
  {
    EXPECT_EQ(value[0], 0.);
  }
}

// Only the ratios of weights count, and a point of thrice the weight counts as three.
TEST(AttributeFit, Weights)
{
  const Mesh mesh = makeFan(6);
  const CloudPlaces::Corners atCenter{ { { 0, 1. }, { 1, 0. }, { 2, 0. } } };
  const auto valueAtCenter = [&](double first, double second)
  {
    AttributeFit fit(mesh);
    fit.add(atCenter, first, Fitted::Constant(1.));
    fit.add(atCenter, second, Fitted::Constant(5.));
    return fit.solve()[0][0];
  };
  EXPECT_NEAR(valueAtCenter(1., 1.), 3., 1e-5);
  EXPECT_NEAR(valueAtCenter(3., 1.), 2., 1e-5);
  EXPECT_NEAR(valueAtCenter(300., 100.), 2., 1e-5);
}
}
