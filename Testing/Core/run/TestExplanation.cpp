// SPDX-License-Identifier: BSD-3-Clause
// Promise: each point that a mesh does not explain has the reason that is its own, pieces are told by where
// they are and how many points they have, and what explains a cloud is not warned of.
#include "run/Explanation.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "HasWarning.h"
#include "PointMeasures.h"
#include "run/Reconstruction.h"
#include "run/Warnings.h"
#include "Shapes.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t All = std::size_t(-1);
const Eigen::Vector3d FarSphere(4., 1., -2.);

std::vector<Eigen::Vector3d> sphere(
  std::size_t count, const Eigen::Vector3d& center = { 0., 0., 0. }, double noise = 0.)
{
  CloudOptions options;
  options.count = count;
  options.noise = noise;
  std::vector<Eigen::Vector3d> points = generateCloud(makeSphere(), options);
  for (Eigen::Vector3d& point : points)
  {
    point += center;
  }
  return points;
}

void append(std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& more)
{
  points.insert(points.end(), more.begin(), more.end());
}

/// Points anywhere in a cube.
std::vector<Eigen::Vector3d> clutter(std::size_t count, double halfWidth)
{
  std::mt19937 engine(7);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& point : points)
  {
    for (double& coordinate : point)
    {
      coordinate = halfWidth * (2. * double(engine()) / 4294967295. - 1.);
    }
  }
  return points;
}

/// Points in a row, upwards from the pole of the sphere or so far above it.
std::vector<Eigen::Vector3d> rod(std::size_t count, double spacing, double shift = 0.)
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 1; i <= count; ++i)
  {
    points.emplace_back(0., 0., 1. + shift + spacing * double(i));
  }
  return points;
}

/// By a mesh of the unit sphere.
Explanation explained(const PointCloud& cloud, std::size_t most = All)
{
  const Mesh mesh = buildMesh(makeSphere(40), cloud);
  return explain(cloud, distancesTo(mesh, cloud, most), {});
}

double reached(const Explanation& explanation) { return explanation.count(Reason::Explained); }
}

// Promise: where the mesh is right nothing is left out, with and without noise.
TEST(Explanation, WhatIsExplained)
{
  for (const double noise : { 0., 0.005 })
  {
    const Explanation explanation = explained(PointCloud(sphere(20000, { 0., 0., 0. }, noise)));
    EXPECT_EQ(reached(explanation), 20000.);
    EXPECT_EQ(explanation.unexplained(), 0.);
    EXPECT_TRUE(explanation.pieces.empty());
  }
}

// Promise: nothing is missing on a triangle that is so large that vertices of other parts are closer.
TEST(Explanation, LargeTriangles)
{
  constexpr double HalfSide = 3., Below = -1.3;
  TriangleMesh shape = makeSphere(40);
  const auto first = std::uint32_t(shape.points.size());
  for (const double y : { -HalfSide, HalfSide })
  {
    shape.points.emplace_back(-HalfSide, y, Below);
    shape.points.emplace_back(HalfSide, y, Below);
  }
  shape.triangles.push_back({ first, first + 1, first + 2 });
  shape.triangles.push_back({ first + 2, first + 1, first + 3 });
  std::vector<Eigen::Vector3d> points = sphere(20000), table = clutter(4000, HalfSide);
  for (Eigen::Vector3d& point : table)
  {
    point.z() = Below;
  }
  append(points, table);
  const PointCloud cloud(points);
  const Mesh mesh = buildMesh(shape, cloud);
  const PointDistances distances = distancesTo(mesh, cloud, All);
  EXPECT_LT(
    *std::max_element(distances.distances.begin(), distances.distances.end()) * cloud.unit(), 0.01);
  const Explanation explanation = explain(cloud, distances, {});
  EXPECT_EQ(reached(explanation), 24000.);
  EXPECT_TRUE(explanation.pieces.empty());
}

// Promise: a part of the scan that the mesh lacks is unreachable, and told by its center and size; a few
// points of it are a small piece.
TEST(Explanation, MissedPieces)
{
  std::vector<Eigen::Vector3d> points = sphere(20000);
  append(points, sphere(5000, FarSphere));
  const Explanation explanation = explained(PointCloud(points));
  EXPECT_EQ(reached(explanation), 20000.);
  // By chance a point may be far from all others.
  EXPECT_GE(explanation.count(Reason::Unreachable), 4990.);
  EXPECT_NEAR(explanation.unexplainedShare(), 0.2, 1e-3);
  ASSERT_EQ(explanation.pieces.size(), 1u);
  EXPECT_GE(explanation.pieces[0].points, 4990.);
  EXPECT_LT((explanation.pieces[0].center - FarSphere).norm(), 0.05);
  EXPECT_FALSE(explanation.pieces[0].isBeyondBoundary);

  ExplanationRules rules;
  rules.leastPiece = 0.3;
  const PointCloud cloud(points);
  const Mesh mesh = buildMesh(makeSphere(40), cloud);
  const Explanation small = explain(cloud, distancesTo(mesh, cloud, All), rules);
  EXPECT_GE(small.count(Reason::SmallPiece), 4990.);
  EXPECT_TRUE(small.pieces.empty());
}

// Promise: few points that go on from the surface are a part of it that is missing, and no small piece, as those
// are that lie apart.
TEST(Explanation, SmallPartOfTheSurface)
{
  for (const double shift : { 0., 1. })
  {
    std::vector<Eigen::Vector3d> points = sphere(40000);
    append(points, rod(30, 0.012, shift));
    const PointCloud cloud(points);
    const Mesh mesh = buildMesh(makeSphere(40), cloud);
    ExplanationRules rules;
    rules.leastPiece = 0.01;
    const Explanation explanation = explain(cloud, distancesTo(mesh, cloud, All), rules);
    const bool isApart = shift > 0.;
    EXPECT_EQ(explanation.pieces.size(), isApart ? 0u : 1u);
    EXPECT_GT(explanation.count(isApart ? Reason::SmallPiece : Reason::Unreachable), 15.);
    EXPECT_EQ(explanation.count(isApart ? Reason::Unreachable : Reason::SmallPiece), 0.);
  }
}

// Promise: points far from each other are outliers; so are those that the run took for a cluster of them.
TEST(Explanation, Outliers)
{
  std::vector<Eigen::Vector3d> points = sphere(20000);
  append(points, clutter(400, 1.5));
  const Explanation explanation = explained(PointCloud(points));
  // Some lie near the sphere by chance.
  EXPECT_GT(explanation.count(Reason::Outlier), 300.);
  EXPECT_LT(explanation.unexplained(), 20.);
  EXPECT_TRUE(explanation.pieces.empty());

  std::vector<Eigen::Vector3d> two = sphere(20000);
  append(two, sphere(5000, FarSphere));
  const PointCloud cloud(two);
  ExplanationRules rules;
  for (const Vector4 point : cloud.points())
  {
    rules.isLeftOut.push_back(cloud.toInput(point).x() > 2. ? 1 : 0);
  }
  const Mesh mesh = buildMesh(makeSphere(40), cloud);
  EXPECT_EQ(explain(cloud, distancesTo(mesh, cloud, All), rules).count(Reason::Outlier), 5000.);
}

// Promise: a mesh of which most is missing does not take what it lacks for noise.
TEST(Explanation, MostIsMissing)
{
  std::vector<Eigen::Vector3d> points = sphere(5000);
  append(points, sphere(20000, FarSphere));
  EXPECT_NEAR(explained(PointCloud(points)).unexplainedShare(), 0.8, 1e-3);
}

// Promise: where the mesh has a hole and the points have none, that is told.
TEST(Explanation, OpeningsWhereThereArePoints)
{
  const PointCloud cloud(sphere(20000));
  TriangleMesh open = makeSphere(40);
  std::erase_if(open.triangles,
    [&](const auto& triangle)
    { return open.points[triangle[0]].z() > 0.8 && open.points[triangle[1]].z() > 0.8; });
  const Mesh mesh = buildMesh(open, cloud);
  const Explanation explanation = explain(cloud, distancesTo(mesh, cloud, All), {});
  ASSERT_EQ(explanation.pieces.size(), 1u);
  EXPECT_TRUE(explanation.pieces[0].isBeyondBoundary);
  EXPECT_GT(explanation.pieces[0].center.z(), 0.85);
}

// Promise: some points tell what all tell, about.
TEST(Explanation, SomeTellAll)
{
  std::vector<Eigen::Vector3d> points = sphere(40000);
  append(points, sphere(2000, FarSphere));
  const PointCloud cloud(points);
  const Explanation all = explained(cloud), some = explained(cloud, 5000);
  EXPECT_NEAR(some.unexplained(), all.unexplained(), 300.);
  ASSERT_EQ(some.pieces.size(), 1u);
  EXPECT_NEAR(some.pieces[0].points, 2000., 300.);
  EXPECT_LT((some.pieces[0].center - FarSphere).norm(), 0.3);
}

// Promise: vertices rest on all points that are no outliers, and the distance of these is their residual.
TEST(Explanation, Support)
{
  std::vector<Eigen::Vector3d> points = sphere(20000);
  for (Eigen::Vector3d& point : points)
  {
    point *= 1.01;
  }
  points.emplace_back(3., 0., 0.);
  const PointCloud cloud(points);
  const Mesh mesh = buildMesh(makeSphere(40), cloud);
  const VertexSupport support = supportOf(mesh, cloud, All);
  double sum = 0.;
  for (std::size_t v = 0; v < support.weights.size(); ++v)
  {
    sum += support.weights[v];
    if (support.weights[v] > 1.)
    {
      EXPECT_NEAR(support.residuals[v], 0.01, 0.005);
    }
  }
  EXPECT_NEAR(sum, 20000., 20.);
}

// Promise: what vertices rest on is the same by some of the points that are measured as by these alone.
TEST(Explanation, SupportBySome)
{
  const PointCloud cloud(sphere(20000));
  const Mesh mesh = buildMesh(makeSphere(40), cloud);
  const auto measured =
    measurePoints(mesh, cloud, { .all = All, .forSupport = 7000 }, [](double) { return true; });
  ASSERT_TRUE(measured);
  EXPECT_EQ(measured->distances.distances, distancesTo(mesh, cloud, All).distances);
  const VertexSupport some = supportOf(mesh, cloud, 7000);
  EXPECT_EQ(measured->support.weights, some.weights);
  EXPECT_EQ(measured->support.pointsPerAsked, some.pointsPerAsked);
}

namespace
{
Reconstruction reconstructed(const PointCloud& cloud, std::uint64_t vertices)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  return reconstruct(cloud, parameters, [](double) { return true; });
}

}

// Promise: nothing is warned of where the mesh is what the cloud is.
TEST(Warnings, NoneOfASphere)
{
  CloudOptions options;
  options.count = 20000;
  options.noise = 0.005;
  options.outliers = 0.02;
  const Reconstruction result =
    reconstructed(PointCloud(generateCloud(makeSphere(), options)), 2000);
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
}

// Promise: nor of one open sheet, whose sides are as right, but of sheets that nothing turns alike.
TEST(Warnings, Sides)
{
  std::vector<Eigen::Vector3d> sheet = clutter(8000, 1.);
  for (Eigen::Vector3d& point : sheet)
  {
    point.z() = 0.;
  }
  EXPECT_FALSE(hasWarning(reconstructed(PointCloud(sheet), 500), "The outer side is unknown for"));
  OrientationReport sides;
  sides.pieces = sides.unknownPieces = 2;
  sides.shares[0] = 1.;
  Reconstruction result;
  result.orientation = sides;
  result.warnings = warningsOf(result, PointCloud(sheet));
  EXPECT_TRUE(hasWarning(result, "The outer side is unknown for"));
  EXPECT_TRUE(hasWarning(result, "--viewpoint"));
}

// Promise: a mesh that is finer than its data is told, with how many vertices bear it.
TEST(Warnings, FinerThanData)
{
  const Reconstruction result = reconstructed(PointCloud(sphere(1000)), 700);
  EXPECT_TRUE(hasWarning(result, "700 vertices for 1000 different points"));
  EXPECT_FALSE(hasWarning(reconstructed(PointCloud(sphere(1000)), 400), "finer"));
}

// Promise: what a mesh lacks is told, with the place, and so are defects that are left.
TEST(Warnings, MissingPartAndDefects)
{
  std::vector<Eigen::Vector3d> points = sphere(20000);
  append(points, sphere(5000, FarSphere));
  const PointCloud cloud(points);
  Reconstruction result;
  result.explanation = explained(cloud);
  result.quality = MeshQuality{};
  result.quality->surface.foldedEdges = 3;
  result.finish = FinishReport{};
  result.finish->left.intersectingTriangles = 2;
  result.finish->roundsTakenBack = 1;
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "20 % of the points"));
  EXPECT_TRUE(hasWarning(result, "missing in the mesh: about "));
  EXPECT_TRUE(hasWarning(result, "2 triangles intersect"));
  EXPECT_TRUE(hasWarning(result, "folded at 3 edges"));
  EXPECT_TRUE(hasWarning(result, "1 round of the fit"));
  EXPECT_EQ(result.warnings.size(), 5u);
}

// Promise: a rod that has but a few of very many points is not lost without a word.
TEST(Warnings, LostRod)
{
  std::vector<Eigen::Vector3d> points = sphere(200000);
  EXPECT_TRUE(reconstructed(PointCloud(points), 2000).warnings.empty());
  append(points, rod(80, 0.004));
  EXPECT_TRUE(hasWarning(reconstructed(PointCloud(points), 2000), "missing in the mesh"));
}

// Promise: what is no farther away than half an edge is called coarse, not missing.
TEST(Warnings, CoarseIsNotMissing)
{
  Reconstruction result;
  result.explanation.emplace();
  result.explanation->asked.meanEdge = 0.1;
  const PointCloud cloud(sphere(1000));
  MissedPiece piece;
  piece.points = 120.;
  piece.farthest = 0.04 * cloud.unit();
  result.explanation->pieces.push_back(piece);
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "coarser than its cloud: about 120 points"));
  EXPECT_FALSE(hasWarning(result, "missing"));
  EXPECT_TRUE(hasWarning(result, "Use more vertices."));
  // More would be finer than the data.
  result.mesh.points.resize(410);
  result.warnings = warningsOf(result, cloud);
  EXPECT_TRUE(hasWarning(result, "Scan more points, and use more vertices then."));
  result.explanation->pieces[0].farthest = 0.06 * cloud.unit();
  result.warnings = warningsOf(result, cloud);
  EXPECT_FALSE(hasWarning(result, "coarser"));
  EXPECT_TRUE(hasWarning(result, "missing in the mesh: about 120 points"));
}

// Promise: heights that were not measured are told before all that follows from them, such as that the others seem to lie
// on a line.
TEST(Warnings, UnmeasuredPoints)
{
  for (const double height : { -9999., 1e20 })
  {
    std::vector<Eigen::Vector3d> points = sphere(2000);
    for (std::size_t i = 0; i < 200; ++i)
    {
      points[i].z() = height;
    }
    Reconstruction result;
    result.warnings = warningsOf(result, PointCloud(points));
    ASSERT_FALSE(result.warnings.empty());
    EXPECT_TRUE(result.warnings[0].starts_with("200 points have the same z, about "));
    EXPECT_TRUE(result.warnings[0].ends_with("[unmeasured-points]"));
  }
}

// Promise: a rim that is cut off is told, by how much and how many points have it, though no point is farther away than
// three of its distances to others; but none of a mesh that reaches its points.
TEST(Warnings, RimsThatAreCutOff)
{
  constexpr double Thickness = 0.02, CutOff = 0.03;
  const PointCloud cloud(platePoints(20000, Thickness));
  const auto cutOffBy = [](double width, TriangleMesh mesh)
  {
    for (Eigen::Vector3d& point : mesh.points)
    {
      point.head<2>() = ((1. - 2. * width) * point.head<2>()).array() + width;
    }
    return mesh;
  };
  const auto warnedOf = [&](const TriangleMesh& mesh)
  {
    const Mesh surface = buildMesh(mesh, cloud);
    Reconstruction result;
    result.explanation = explain(cloud, distancesTo(surface, cloud, All), {});
    result.warnings = warningsOf(result, cloud);
    return result;
  };
  const TriangleMesh plate = makePlate(20, Thickness);
  const Reconstruction reached = warnedOf(plate);
  EXPECT_EQ(reached.explanation->atRims.count, 0u);
  EXPECT_TRUE(reached.warnings.empty());
  const Reconstruction cut = warnedOf(cutOffBy(CutOff, plate));
  EXPECT_TRUE(hasWarning(cut, "coarser than its cloud: it cuts off about "));
  EXPECT_GT(cut.explanation->atRims.farthest, 0.8 * CutOff);
  EXPECT_LT(cut.explanation->atRims.farthest, 1.5 * CutOff);
  EXPECT_GT(cut.explanation->atRims.count, 200u);
  EXPECT_TRUE(hasWarning(cut, "Use more vertices."));
  Reconstruction fine = cut;
  fine.mesh.points.resize(8100);
  fine.warnings = warningsOf(fine, cloud);
  EXPECT_TRUE(hasWarning(fine, "Scan more points"));
  // It is told once.
  Reconstruction named = cut;
  named.explanation->pieces.emplace_back().farthest = 0.4 * named.explanation->asked.meanEdge;
  named.warnings = warningsOf(named, cloud);
  EXPECT_FALSE(hasWarning(named, "it cuts off"));
}

// Promise: where a sheet ends in sparse points, it is told if the mesh ends well before them, and not if it reaches them.
TEST(Warnings, EndsBeforeSparsePoints)
{
  std::vector<Eigen::Vector3d> points = platePoints(20000, 0.);
  // Six distances between points apart, at one side.
  for (int i = 1; i <= 5; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      points.emplace_back(1. + 0.05 * i, 0.05 * j, 0.);
    }
  }
  const PointCloud cloud(points);
  const auto warnedOf = [&](double end)
  {
    TriangleMesh mesh = makeGrid(20);
    for (Eigen::Vector3d& point : mesh.points)
    {
      point[0] *= end;
    }
    const Mesh surface = buildMesh(mesh, cloud);
    Reconstruction result;
    result.explanation = explain(cloud, distancesTo(surface, cloud, All), {});
    result.warnings = warningsOf(result, cloud);
    return result;
  };
  EXPECT_TRUE(warnedOf(1.25).warnings.empty());
  EXPECT_TRUE(warnedOf(1.22).warnings.empty());
  const Reconstruction ended = warnedOf(1.13);
  EXPECT_TRUE(hasWarning(ended, "open where there are points: it does not reach about "));
  EXPECT_GE(ended.explanation->beyondEnds.count, 15u);
  EXPECT_LE(ended.explanation->beyondEnds.count, 21u);
  EXPECT_NEAR(ended.explanation->beyondEnds.farthest, 0.12, 1e-3);
}

// Promise: surface without points is told, with how much of it there is; where the cloud is sparse there are
// points, and where gaps were to be closed none are expected.
TEST(Warnings, BareArea)
{
  const auto made = [](double sparse, const Parameters& parameters)
  {
    std::mt19937 engine(3);
    std::vector<Eigen::Vector3d> points = sphere(100000);
    std::erase_if(points,
      [&](const Eigen::Vector3d& point)
      { return point.x() > 0.5 && double(engine()) >= sparse * 4294967295.; });
    const PointCloud cloud(points);
    Reconstruction result;
    result.mesh = makeSphere(16);
    result.support = supportOf(buildMesh(result.mesh, cloud), cloud, All);
    result.warnings = warningsOf(result, cloud, parameters);
    return result;
  };
  Parameters closing, filling;
  closing.boundaries = Boundaries::Close;
  filling.closeHolesBelow = 1.;
  // A cap of a sphere has the area of its height; at its rim vertices rest on points beyond.
  const Reconstruction bare = made(0., {});
  ASSERT_EQ(bare.warnings.size(), 1u);
  EXPECT_NEAR(std::stod(bare.warnings.front()), 22., 3.);
  EXPECT_TRUE(hasWarning(bare, "almost no points"));
  EXPECT_TRUE(made(0.05, {}).warnings.empty());
  EXPECT_TRUE(made(0., closing).warnings.empty());
  EXPECT_TRUE(made(0., filling).warnings.empty());
}

// Promise: a piece without points is told of, however small it is.
TEST(Warnings, BarePieces)
{
  const PointCloud cloud(sphere(20000));
  const auto warned = [&](const Eigen::Vector3d& place)
  {
    Reconstruction result;
    result.mesh = makeSphere(16);
    const std::size_t first = result.mesh.points.size();
    for (const Eigen::Vector3d& point : makeSphere(1).points)
    {
      result.mesh.points.emplace_back(0.02 * point + place);
    }
    for (const auto& [a, b, c] : makeSphere(1).triangles)
    {
      result.mesh.triangles.push_back(
        { std::uint32_t(a + first), std::uint32_t(b + first), std::uint32_t(c + first) });
    }
    result.surface = buildMesh(result.mesh, cloud);
    result.support = supportOf(result.surface, cloud, All);
    result.warnings = warningsOf(result, cloud);
    return hasWarning(result, "1 piece of the mesh without any points, as around (");
  };
  EXPECT_TRUE(warned({ 2., 0., 0. }));
  EXPECT_FALSE(warned({ 1.02, 0., 0. }));
}
}
