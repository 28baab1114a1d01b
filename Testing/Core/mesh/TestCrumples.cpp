// SPDX-License-Identifier: BSD-3-Clause
// Promise: a mesh whose vertices lie all over a layer of noise leads through the middle of it afterwards; one that follows
// a shape stays as it is, however coarse or thin it is.
#include "mesh/Crumples.h"

#include "base/ThreadPool.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// The unit sphere, with vertices moved by normally distributed numbers with this deviation.
Mesh noisySphere(double deviation)
{
  TriangleMesh sphere = makeSphere(48);
  Random random(7);
  const auto moved = [&](double x)
  {
    const double radius = std::sqrt(-2. * std::log(1. - random.uniform()));
    return x + deviation * radius * std::cos(2. * std::numbers::pi * random.uniform());
  };
  for (Eigen::Vector3d& point : sphere.points)
  {
    point = point.unaryExpr(moved).eval();
  }
  return meshOf(sphere);
}

/// A closed rod around a circle, with so many edges around it.
TriangleMesh makeWire(unsigned around)
{
  constexpr unsigned Along = 400;
  constexpr double Radius = 0.01;
  TriangleMesh wire;
  for (unsigned i = 0; i < Along; ++i)
  {
    for (unsigned j = 0; j < around; ++j)
    {
      const double u = 2. * std::numbers::pi * i / Along, v = 2. * std::numbers::pi * j / around;
      const double r = 1. + Radius * std::cos(v);
      wire.points.emplace_back(r * std::cos(u), r * std::sin(u), Radius * std::sin(v));
      const auto at = [&](unsigned step, unsigned turn)
      { return std::uint32_t((i + step) % Along * around + (j + turn) % around); };
      wire.triangles.push_back({ at(0, 0), at(1, 0), at(1, 1) });
      wire.triangles.push_back({ at(0, 0), at(1, 1), at(0, 1) });
    }
  }
  return wire;
}

void expectUntouched(Mesh mesh)
{
  const std::vector<Vector4> before(mesh.positions().begin(), mesh.positions().end());
  EXPECT_TRUE(smoothCrumples(mesh).empty());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    ASSERT_EQ(squaredNorm(mesh.position(v) - before[v]), 0.f);
  }
}
}

TEST(Crumples, AreSmoothed)
{
  const double area = areaOf(noisySphere(0.));
  for (const double deviation : { 0.1, 0.2 })
  {
    SCOPED_TRACE(deviation);
    Mesh mesh = noisySphere(deviation);
    ASSERT_GT(areaOf(mesh), 2. * area);
    const std::vector<Vector4> before(mesh.positions().begin(), mesh.positions().end());
    const std::vector<Vector4> told = smoothCrumples(mesh);
    ASSERT_EQ(told.size(), before.size());
    for (std::size_t v = 0; v < told.size(); ++v)
    {
      ASSERT_EQ(squaredNorm(told[v] - before[v]), 0.f);
    }
    EXPECT_NEAR(areaOf(mesh) / area, 1., 0.05);
    EXPECT_EQ(defectOf(mesh), "");
    EXPECT_TRUE(smoothCrumples(mesh).empty());
  }
}

TEST(Crumples, ShapesStay)
{
  expectUntouched(noisySphere(0.));
  expectUntouched(noisySphere(0.008));
  expectUntouched(meshOf(makeSphere(1)));
  expectUntouched(meshOf(makeTorus(0.1, 12)));
  for (const unsigned around : { 3u, 4u, 5u })
  {
    SCOPED_TRACE(around);
    expectUntouched(meshOf(makeWire(around)));
  }
}

TEST(Crumples, AnyThreads)
{
  ThreadPool threads(3);
  Mesh one = noisySphere(0.2), several = one;
  EXPECT_EQ(smoothCrumples(one).size(), smoothCrumples(several, threads).size());
  for (VertexIndex v = 0; v < one.indexEnd(); ++v)
  {
    ASSERT_EQ(squaredNorm(one.position(v) - several.position(v)), 0.f);
  }
}
}
