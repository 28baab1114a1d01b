// SPDX-License-Identifier: BSD-3-Clause
#include "fit/FitSystem.h"

#include "mesh/UmbrellaLaplacian.h"

#include "MeshTools.h"
#include "SphereRuns.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
struct Sample
{
  PlaceOnMesh place;
  Vector4 point;
  Vector4 normal;
  float weight;
};

/// At random places of random triangles, some of them at corners and edges, and some without a
/// normal.
std::vector<Sample> makeSamples(const Mesh& mesh, std::size_t count, Random& random)
{
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < count; ++i)
  {
    Sample sample;
    sample.place.triangle = triangles[random.below(std::uint32_t(triangles.size()))];
    std::rotate(sample.place.triangle.begin(), sample.place.triangle.begin() + random.below(3),
      sample.place.triangle.end());
    const auto b = float(0.5 * random.uniform()), c = float(0.5 * random.uniform());
    sample.place.second = i % 7 == 0 ? 0.f : b;
    sample.place.third = i % 7 == 0 || i % 5 == 0 ? 0.f : c;
    sample.point = randomPoint(random);
    sample.normal = i % 3 == 0 ? Vector4() : randomPoint(random, 3.f);
    sample.weight = float(0.5 + random.uniform());
    samples.push_back(sample);
  }
  return samples;
}

/// The umbrella Laplacian from bare triangles: of a vertex on a boundary, that along it.
Eigen::MatrixXd denseLaplacian(const Mesh& mesh)
{
  const std::vector<Triangle> triangles = trianglesOf(mesh);
  std::map<std::pair<VertexIndex, VertexIndex>, int> edges;
  for (const Triangle& triangle : triangles)
  {
    for (unsigned k = 0; k < 3; ++k)
    {
      const VertexIndex a = triangle[k], b = triangle[(k + 1) % 3];
      ++edges[std::minmax(a, b)];
    }
  }
  const auto n = Eigen::Index(mesh.indexEnd());
  std::vector<std::set<VertexIndex>> all(mesh.indexEnd()), along(mesh.indexEnd());
  for (const auto& [edge, count] : edges)
  {
    const auto& [a, b] = edge;
    all[a].insert(b);
    all[b].insert(a);
    if (count == 1)
    {
      along[a].insert(b);
      along[b].insert(a);
    }
  }
  Eigen::MatrixXd laplacian = -Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index v = 0; v < n; ++v)
  {
    const auto& neighbors =
      along[std::size_t(v)].empty() ? all[std::size_t(v)] : along[std::size_t(v)];
    for (const VertexIndex neighbor : neighbors)
    {
      laplacian(v, Eigen::Index(neighbor)) += 1. / double(neighbors.size());
    }
  }
  return laplacian;
}

Eigen::VectorXd denseSolution(
  const Mesh& mesh, const std::vector<Sample>& samples, double slip, double lambda)
{
  const auto n = Eigen::Index(mesh.indexEnd());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * n);
  for (const Sample& sample : samples)
  {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(3, 3 * n);
    for (int i = 0; i < 3; ++i)
    {
      b.middleCols<3>(3 * Eigen::Index(sample.place.triangle[std::size_t(i)])) +=
        double(sample.place.weights()[i]) * Eigen::Matrix3d::Identity();
    }
    Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
    const Eigen::Vector3d normal = sample.normal.toDouble();
    if (normal.norm() > 0.)
    {
      const Eigen::Vector3d unit = normal.normalized();
      weight = slip * Eigen::Matrix3d::Identity() + (1. - slip) * unit * unit.transpose();
    }
    weight *= double(sample.weight);
    matrix += b.transpose() * weight * b;
    right += b.transpose() * weight * sample.point.toDouble();
  }
  const Eigen::MatrixXd laplacian = denseLaplacian(mesh);
  Eigen::VectorXd smoothness(n);
  for (Eigen::Index v = 0; v < n; ++v)
  {
    smoothness[v] = mesh.isBoundary(VertexIndex(v))
      ? std::min(lambda, FitSystem::MostBoundarySmoothness)
      : lambda;
  }
  const Eigen::MatrixXd squared = laplacian.transpose() * smoothness.asDiagonal() * laplacian;
  for (Eigen::Index i = 0; i < n; ++i)
  {
    for (Eigen::Index j = 0; j < n; ++j)
    {
      matrix.block<3, 3>(3 * i, 3 * j) += squared(i, j) * Eigen::Matrix3d::Identity();
    }
  }
  return matrix.ldlt().solve(right);
}

std::vector<Mesh> meshes()
{
  Random random(1);
  std::vector<Mesh> result;
  for (const bool isOpen : { false, true })
  {
    for (int i = 0; i < 4; ++i)
    {
      result.push_back(makeRandomMesh(30, random));
      if (isOpen)
      {
        tear(result.back(), 3, random);
        result.back().dropErased();
      }
    }
  }
  return result;
}

std::vector<Vector4> positionsOf(const Mesh& mesh)
{
  return { mesh.positions().begin(), mesh.positions().end() };
}
}

// The Laplacian is that of the definition, on closed meshes and on open ones.
TEST(FitSystem, LaplacianIsThatOfTheDefinition)
{
  for (const Mesh& mesh : meshes())
  {
    const std::vector<Vector4> x = positionsOf(mesh);
    std::vector<Vector4> laplacian(x.size());
    applyUmbrella<float>(mesh, std::span<const Vector4>(x), std::span(laplacian), 0, x.size());
    Eigen::MatrixXd dense(Eigen::Index(x.size()), 3);
    for (std::size_t v = 0; v < x.size(); ++v)
    {
      dense.row(Eigen::Index(v)) = x[v].toDouble();
    }
    dense = denseLaplacian(mesh) * dense;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
      EXPECT_LT((laplacian[v].toDouble() - dense.row(Eigen::Index(v)).transpose()).norm(), 1e-5);
    }
  }
}

// The solution is that of the dense system: for closed and open meshes, any slip and smoothness.
TEST(FitSystem, SolvesTheDenseSystem)
{
  Random random(2);
  for (const Mesh& mesh : meshes())
  {
    for (const double slip : { 1., 0.1, 0.01 })
    {
      for (const double lambda : { 0.1, 1., 30. })
      {
        SCOPED_TRACE(std::to_string(slip) + ", " + std::to_string(lambda));
        const std::vector<Sample> samples = makeSamples(mesh, 400, random);
        FitSystem system(mesh, slip);
        for (const Sample& sample : samples)
        {
          system.add(sample.place, sample.point, sample.normal, sample.weight);
        }
        std::vector<Vector4> x = positionsOf(mesh);
        double scale = 0.;
        ASSERT_TRUE(system.solve(lambda, 1e-6, scale, x, goOn));
        EXPECT_GT(scale, 0.);
        const Eigen::VectorXd expected = denseSolution(mesh, samples, slip, lambda);
        for (std::size_t v = 0; v < x.size(); ++v)
        {
          EXPECT_LT((x[v].toDouble() - expected.segment<3>(3 * Eigen::Index(v))).norm(), 1e-3);
        }
      }
    }
  }
}

// In place of what samples pull to and of bends of 0, others may be given: the matrix stays.
TEST(FitSystem, SolvesForOtherPullsAndBends)
{
  Random random(8);
  constexpr double Lambda = 30.;
  for (const Mesh& mesh : meshes())
  {
    const std::vector<Sample> samples = makeSamples(mesh, 400, random);
    const auto n = Eigen::Index(mesh.indexEnd());
    FitSystem system(mesh, 1.);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n), right = Eigen::MatrixXd::Zero(n, 3);
    std::vector<float> parts;
    std::vector<Vector4> bends;
    Eigen::MatrixXd denseBends(n, 3);
    Eigen::VectorXd smoothness(n);
    for (Eigen::Index v = 0; v < n; ++v)
    {
      parts.push_back(float(0.2 + random.uniform()));
      bends.push_back(randomPoint(random));
      denseBends.row(v) = bends.back().toDouble();
      smoothness[v] = mesh.isBoundary(VertexIndex(v)) ? FitSystem::MostBoundarySmoothness
                                                      : Lambda * double(parts.back());
    }
    for (const Sample& sample : samples)
    {
      system.add(sample.place, sample.point, Vector4(), sample.weight);
    }
    system.clearPulls();
    for (const Sample& sample : samples)
    {
      const Vector4 pull = randomPoint(random);
      system.addPull(sample.place, pull);
      Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
      for (int i = 0; i < 3; ++i)
      {
        b[Eigen::Index(sample.place.triangle[std::size_t(i)])] += double(sample.place.weights()[i]);
      }
      matrix += double(sample.weight) * b * b.transpose();
      right += b * pull.toDouble().transpose();
    }
    system.setSmoothnessParts(parts);
    system.addBends(Lambda, bends);
    const Eigen::MatrixXd laplacian = denseLaplacian(mesh);
    const Eigen::MatrixXd smooth = laplacian.transpose() * smoothness.asDiagonal();
    const Eigen::MatrixXd expected =
      (matrix + smooth * laplacian).ldlt().solve(right + smooth * denseBends);
    std::vector<Vector4> x(mesh.indexEnd());
    double scale = 0.;
    ASSERT_TRUE(system.solve(Lambda, 1e-6, scale, x, goOn));
    for (Eigen::Index v = 0; v < n; ++v)
    {
      EXPECT_LT((x[std::size_t(v)].toDouble() - expected.row(v).transpose()).norm(), 1e-3);
    }
  }
}

// A triangle so small that dividing by the square of its normal is beyond all numbers counts as one
// without a plane, and does the rest of the system no harm.
TEST(FitSystem, TinyNormalsAreNone)
{
  const auto solutionWith = [](Vector4 normal)
  {
    Random random(6);
    const Mesh mesh = makeRandomMesh(100, random);
    std::vector<Sample> samples = makeSamples(mesh, 400, random);
    samples[0].normal = normal;
    FitSystem system(mesh, 0.01);
    for (const Sample& sample : samples)
    {
      system.add(sample.place, sample.point, sample.normal, sample.weight);
    }
    std::vector<Vector4> x = positionsOf(mesh);
    double scale = 0.;
    EXPECT_TRUE(system.solve(1., 1e-6, scale, x, goOn));
    EXPECT_GT(scale, 0.);
    return x;
  };
  const std::vector<Vector4> expected = solutionWith(Vector4());
  for (const float size : { 1e-16f, 1e-18f, 1e-20f, 1e-22f, 1e-30f })
  {
    const std::vector<Vector4> x = solutionWith(Vector4(size, 0.f, -size));
    for (std::size_t v = 0; v < x.size(); ++v)
    {
      EXPECT_EQ(squaredNorm(x[v] - expected[v]), 0.f);
    }
  }
}

// The tolerance is one of the scale: what is near enough for it stays as it is.
TEST(FitSystem, NearEnoughIsLeft)
{
  Random random(4);
  const Mesh mesh = makeRandomMesh(200, random);
  FitSystem system(mesh, 0.01);
  for (const Sample& sample : makeSamples(mesh, 2000, random))
  {
    system.add(sample.place, sample.point, sample.normal, sample.weight);
  }
  const std::vector<Vector4> start = positionsOf(mesh);
  std::vector<Vector4> x = start;
  double scale = 1e9;
  ASSERT_TRUE(system.solve(10., 1e-3, scale, x, goOn));
  EXPECT_EQ(scale, 1e9);
  for (std::size_t v = 0; v < x.size(); ++v)
  {
    EXPECT_EQ(squaredNorm(x[v] - start[v]), 0.f);
  }
}

// Ended before its end, it says so; and progress never falls.
TEST(FitSystem, CanBeEnded)
{
  Random random(3);
  const Mesh mesh = makeRandomMesh(200, random);
  FitSystem system(mesh, 0.01);
  for (const Sample& sample : makeSamples(mesh, 2000, random))
  {
    system.add(sample.place, sample.point, sample.normal, sample.weight);
  }
  std::vector<Vector4> x = positionsOf(mesh);
  std::vector<double> told;
  double scale = 0.;
  ASSERT_TRUE(system.solve(10., 1e-4, scale, x,
    [&](double fraction)
    {
      told.push_back(fraction);
      return true;
    }));
  ASSERT_GT(told.size(), 2u);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0.);
  EXPECT_LE(told.back(), 1.);
  for (std::size_t last = 0; last < told.size(); ++last)
  {
    std::size_t left = last;
    x = positionsOf(mesh);
    EXPECT_FALSE(system.solve(10., 1e-4, scale, x, [&](double) { return left-- > 0; }));
  }
}
}
