// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SurfaceFit.h"

#include "cloud/MeshBuilder.h"
#include "mesh/SurfaceReport.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "SphereRuns.h"
#include "ThinPlate.h"
#include "TrueSurfaces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
PointCloud noisySphere(double noise, double outliers = 0., std::size_t count = 60000)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  options.outliers = outliers;
  return PointCloud(generateCloud(makeSphere(), options));
}

/// A sphere whose points are moved at random, by this part of the radius at most along each axis.
Mesh roughSphere(const PointCloud& cloud, double strength, unsigned resolution = 18)
{
  TriangleMesh sphere = makeSphere(resolution);
  Random random(4);
  for (Eigen::Vector3d& point : sphere.points)
  {
    point += randomPoint(random, float(strength)).toDouble();
  }
  return buildMesh(std::move(sphere), cloud);
}

constexpr std::size_t SamplesPerVertex = 10;
constexpr int Rounds = 3;

SurfaceFit fitted(const PointCloud& cloud, Mesh& mesh, double lambda)
{
  SurfaceFit fit(cloud, mesh, SamplesPerVertex * mesh.vertexCount());
  for (int round = 0; round < Rounds; ++round)
  {
    EXPECT_TRUE(fit.findPlaces(goOn));
    EXPECT_TRUE(fit.moveVertices(round == 0 ? lambda : fit.smoothness(), goOn));
  }
  return fit;
}

double meanDistance(
  const PointCloud& cloud, const std::vector<Eigen::Vector3d>& points, const Mesh& mesh)
{
  const VertexGrid grid = gridOf(mesh, cloud);
  double sum = 0.;
  for (const Eigen::Vector3d& point : points)
  {
    sum += std::sqrt(double(closestPlace(cloud.fromInput(point), mesh, grid).squaredDistance));
  }
  return cloud.unit() * sum / double(points.size());
}

std::vector<Eigen::Vector3d> pointsOf(const Mesh& mesh)
{
  std::vector<Eigen::Vector3d> points;
  for (const Vector4 position : mesh.positions())
  {
    points.push_back(position.toDouble());
  }
  return points;
}
}

// A fit brings the surface to the cloud: from a rough mesh to at most a third of its distance.
TEST(SurfaceFit, ComesCloser)
{
  const TrueSurface sphere = trueSphere();
  for (const double lambda : { 0., 0.1 })
  {
    const PointCloud cloud = noisySphere(0.);
    Mesh mesh = roughSphere(cloud, 0.02);
    const TriangleMesh before = trianglesOf(mesh, cloud);
    fitted(cloud, mesh, lambda);
    const TriangleMesh after = trianglesOf(mesh, cloud);
    EXPECT_LT(rmsDistance(sphere, after), rmsDistance(sphere, before) / 3.);
    EXPECT_LT(largestDistance(sphere, after), largestDistance(sphere, before) / 3.);
    EXPECT_EQ(after.triangles, before.triangles);
  }
}

// A clean cloud is followed closely, a noisy one is smoothed: the more, the more noise there is.
TEST(SurfaceFit, SmoothnessRisesWithNoise)
{
  double before = 0.;
  for (const double noise : { 0., 0.0025, 0.005, 0.01 })
  {
    const PointCloud cloud = noisySphere(noise);
    Mesh mesh = roughSphere(cloud, 0.01);
    const double smoothness = fitted(cloud, mesh, 0.).smoothness();
    EXPECT_GT(smoothness, before);
    before = smoothness;
  }
}

// Where bends are shape, the search for lambda begins near it. Where a rough mesh hides noise, it begins anew from a
// smooth surface.
TEST(SurfaceFit, SearchBeginsNearForCleanClouds)
{
  const auto choicesFor = [](double noise, double strength)
  {
    const PointCloud cloud = noisySphere(noise);
    Mesh mesh = roughSphere(cloud, strength);
    SurfaceFit fit(cloud, mesh, SamplesPerVertex * mesh.vertexCount());
    fit.searchNear();
    EXPECT_TRUE(fit.findPlaces(goOn));
    // The choice takes 0.6 of the progress, an eighth of that for each lambda.
    double last = 0.;
    const auto watch = [&last](double fraction)
    {
      last = fraction < 0.6 ? std::max(last, fraction) : last;
      return true;
    };
    EXPECT_TRUE(fit.moveVertices(0., watch));
    return 1 + int(last / (0.6 / 8.));
  };
  EXPECT_LE(choicesFor(0.0005, 0.01), 2);
  EXPECT_GE(choicesFor(0.004, 0.06), 3);
}

// The noise of a cloud is known within 15 %, whatever its outliers are.
TEST(SurfaceFit, NoiseIsMeasured)
{
  for (const double noise : { 0.005, 0.01 })
  {
    for (const double outliers : { 0., 0.05 })
    {
      SCOPED_TRACE(std::to_string(noise) + ", outliers " + std::to_string(outliers));
      const PointCloud cloud = noisySphere(noise, outliers);
      Mesh mesh = roughSphere(cloud, 0.01);
      const SurfaceFit fit = fitted(cloud, mesh, 0.);
      const double truth = noise * SphereDiagonal;
      EXPECT_NEAR(fit.noise() * cloud.unit(), truth, 0.15 * truth);
    }
  }
}

// With noise the chosen smoothness is better than hardly any.
TEST(SurfaceFit, ChoiceIsBetterThanNone)
{
  const TrueSurface sphere = trueSphere();
  const PointCloud cloud = noisySphere(0.005);
  Mesh chosen = roughSphere(cloud, 0.01), rough = chosen;
  fitted(cloud, chosen, 0.);
  fitted(cloud, rough, 0.05);
  EXPECT_LT(rmsDistance(sphere, trianglesOf(chosen, cloud)),
    0.7 * rmsDistance(sphere, trianglesOf(rough, cloud)));
}

// A smoothness that is asked for is used.
TEST(SurfaceFit, TakesTheGivenSmoothness)
{
  const PointCloud cloud = noisySphere(0.005);
  Mesh mesh = roughSphere(cloud, 0.01);
  EXPECT_EQ(fitted(cloud, mesh, 7.).smoothness(), 7.);
}

// Outliers are told from points of the surface: their share is right, and they do not pull.
TEST(SurfaceFit, OutliersDoNotPull)
{
  const TrueSurface sphere = trueSphere();
  const PointCloud cloud = noisySphere(0.001, 0.1);
  Mesh mesh = roughSphere(cloud, 0.01);
  const SurfaceFit fit = fitted(cloud, mesh, 0.);
  // Of all points one in eleven is an outlier; some of these lie on the surface by chance.
  EXPECT_GT(fit.outlierShare(), 0.06);
  EXPECT_LT(fit.outlierShare(), 1. / 11. + 0.01);
  EXPECT_LT(largestDistance(sphere, trianglesOf(mesh, cloud)), 0.005 * sphere.diagonal);
}

/// The unit square with many points in its left half and few in the right one, which rises there
/// like a roof.
std::vector<Eigen::Vector3d> roofedSquare(std::size_t dense, std::size_t sparse, double height)
{
  Random random(7);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < dense + sparse; ++i)
  {
    const double x = 0.5 * random.uniform(), y = random.uniform();
    points.emplace_back(
      i < dense ? x : 0.5 + x, y, i < dense ? 0. : height * (0.5 - std::abs(x - 0.25)));
  }
  return points;
}

// Where points are sparse a distance that would be an outlier's elsewhere is none: the fit brings the
// mesh to them.
TEST(SurfaceFit, SparsePointsAreNoOutliers)
{
  const std::vector<Eigen::Vector3d> points = roofedSquare(40000, 400, 0.2);
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(makeGrid(20), cloud);
  fitted(cloud, mesh, 0.1);
  const std::vector<Eigen::Vector3d> sparse(points.begin() + 40000, points.end());
  EXPECT_LT(meanDistance(cloud, sparse, mesh), 0.02);
}

// Vertices stay where they are if samples would be lost: however smooth the surface is to be, points
// that lay on it are near to it afterwards.
TEST(SurfaceFit, LosesNoSamples)
{
  const std::vector<Eigen::Vector3d> points = roofedSquare(0, 40000, 2.);
  const PointCloud cloud(points);
  TriangleMesh roof = makeGrid(40);
  for (Eigen::Vector3d& point : roof.points)
  {
    point = { 0.5 + 0.5 * point.x(), point.y(), 2. * (0.5 - std::abs(0.5 * point.x() - 0.25)) };
  }
  Mesh mesh = buildMesh(std::move(roof), cloud);
  SurfaceFit fit(cloud, mesh, SamplesPerVertex * mesh.vertexCount());
  ASSERT_TRUE(fit.findPlaces(goOn));
  ASSERT_TRUE(fit.moveVertices(1e6, goOn));
  EXPECT_GT(fit.heldCount(), 0u);
  EXPECT_LT(meanDistance(cloud, points, mesh), 0.02);
}

// A boundary ends up where the samples end, whether it was inside or far outside of them.
TEST(SurfaceFit, BoundariesEndWhereSamplesEnd)
{
  CloudOptions options;
  options.count = 40000;
  const TriangleMesh square = makeGrid(20);
  const PointCloud cloud(generateCloud(square, options));
  for (const double size : { 0.97, 1.06 })
  {
    SCOPED_TRACE(size);
    TriangleMesh scaled = square;
    for (Eigen::Vector3d& point : scaled.points)
    {
      point = size * (point - Eigen::Vector3d(0.5, 0.5, 0.)) + Eigen::Vector3d(0.5, 0.5, 0.);
    }
    Mesh mesh = buildMesh(std::move(scaled), cloud);
    fitted(cloud, mesh, 0.);
    const double area = reportSurface(trianglesOf(mesh, cloud)).area;
    EXPECT_NEAR(area, 1., 0.02);
  }
}

// If that is asked for, a single round brings a boundary inside of the samples to where these end, but for a
// fifth of the way.
TEST(SurfaceFit, BoundariesGetThereInOneRound)
{
  constexpr double Size = 0.97;
  CloudOptions options;
  options.count = 40000;
  const TriangleMesh square = makeGrid(20);
  const PointCloud cloud(generateCloud(square, options));
  TriangleMesh scaled = square;
  for (Eigen::Vector3d& point : scaled.points)
  {
    point = Size * (point - Eigen::Vector3d(0.5, 0.5, 0.)) + Eigen::Vector3d(0.5, 0.5, 0.);
  }
  Mesh mesh = buildMesh(std::move(scaled), cloud);
  SurfaceFit fit(cloud, mesh, options.count);
  fit.reachTheEnd();
  ASSERT_TRUE(fit.findPlaces(goOn));
  ASSERT_TRUE(fit.moveVertices(0., goOn));
  const double area = reportSurface(trianglesOf(mesh, cloud)).area;
  EXPECT_GT(area, 1. - 0.2 * (1. - Size * Size));
  EXPECT_LT(area, 1.01);
}

// The places of samples lie on the triangles of the mesh, and the median distance is theirs.
TEST(SurfaceFit, PlacesAreThoseOfSamples)
{
  const PointCloud cloud = noisySphere(0.005);
  Mesh mesh = roughSphere(cloud, 0.01);
  SurfaceFit fit(cloud, mesh, 5000);
  ASSERT_TRUE(fit.findPlaces(goOn));
  ASSERT_EQ(fit.places().size(), 5000u);
  std::size_t closer = 0;
  for (const PlaceOnMesh& place : fit.places())
  {
    ASSERT_TRUE(mesh.contains(place.triangle));
    closer += std::sqrt(place.squaredDistance) < fit.medianDistance();
  }
  EXPECT_NEAR(double(closer), 2500., 1.);
}

// A run that is ended leaves all vertices where they are.
TEST(SurfaceFit, EndedRunsMoveNothing)
{
  const PointCloud cloud = noisySphere(0.005);
  Mesh mesh = roughSphere(cloud, 0.01);
  SurfaceFit fit(cloud, mesh, SamplesPerVertex * mesh.vertexCount());
  const std::vector<Eigen::Vector3d> before = pointsOf(mesh);
  EXPECT_FALSE(fit.findPlaces([](double) { return false; }));
  ASSERT_TRUE(fit.findPlaces(goOn));
  int calls = 0;
  for (bool isDone = false; !isDone; ++calls)
  {
    int left = calls;
    isDone = fit.moveVertices(0., [&](double) { return left-- > 0; });
    EXPECT_EQ(pointsOf(mesh) == before, !isDone);
  }
  EXPECT_GT(calls, 3);
}

// Of a plate thinner than edges are long, the sides come to where their own points are, though nearest
// vertices are often those of the other side.
TEST(SurfaceFit, SidesOfAThinPlateStayApart)
{
  constexpr unsigned Side = 20;
  constexpr double Thickness = 0.2 / Side;
  const PointCloud cloud(platePoints(20000, Thickness, 0.1 * Thickness));
  Mesh mesh = buildMesh(makePlate(Side, 1.5 * Thickness), cloud);
  fitted(cloud, mesh, 0.1);
  for (const Eigen::Vector3d& point : trianglesOf(mesh, cloud).points)
  {
    const double fromRim = std::min({ point.x(), point.y(), 1. - point.x(), 1. - point.y() });
    if (fromRim > 1.5 / Side)
    {
      EXPECT_NEAR(std::abs(point.z()), 0.5 * Thickness, 0.1 * Thickness);
    }
  }
}

// A sheet between two layers of points is told as such; in noise, evenly spread points, and on a surface that
// is coarser than its bends, hardly any vertex is. Nor does it take many points a vertex.
TEST(SurfaceFit, TellsWhereItLiesBetweenLayers)
{
  constexpr double Thickness = 0.02;
  const auto shareOf = [](const PointCloud& cloud, Mesh mesh)
  {
    SurfaceFit fit(cloud, mesh, SamplesPerVertex * mesh.vertexCount());
    EXPECT_TRUE(fit.findPlaces(goOn));
    return fit.shareBetweenLayers();
  };
  const PointCloud layers(platePoints(20000, Thickness, 0.15 * Thickness));
  const PointCloud noise(platePoints(20000, 0., Thickness));
  for (const int side : { 30, 80 })
  {
    EXPECT_GT(shareOf(layers, buildMesh(makeGrid(side), layers)), 0.9);
    EXPECT_LT(shareOf(noise, buildMesh(makeGrid(side), noise)), 0.1);
  }
  const PointCloud sphere = noisySphere(0.);
  EXPECT_LT(shareOf(sphere, buildMesh(makeSphere(6), sphere)), 0.1);
}
}
