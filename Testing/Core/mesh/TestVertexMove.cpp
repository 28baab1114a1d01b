// SPDX-License-Identifier: BSD-3-Clause
#include "learn/WinGain.h"
#include "mesh/VertexMove.h"

#include "mesh/Pieces.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
namespace
{
/// The normal at a vertex, its triangles weighted by the sine over the lengths of their edges: one
/// weighted by areas does not change when its vertex moves.
Eigen::Vector3d normalAt(const Mesh& mesh, VertexIndex v)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Triangle triangle : trianglesOf(mesh))
  {
    const auto corner = std::find(triangle.begin(), triangle.end(), v);
    if (corner != triangle.end())
    {
      std::rotate(triangle.begin(), corner, triangle.end());
      const Eigen::Vector3d center = mesh.position(v).toDouble();
      const Eigen::Vector3d a = mesh.position(triangle[1]).toDouble() - center;
      const Eigen::Vector3d b = mesh.position(triangle[2]).toDouble() - center;
      sum += a.cross(b) / (a.squaredNorm() * b.squaredNorm());
    }
  }
  return sum.normalized();
}

// The changes are those of the whole mesh: of its area, of its volume, and of the angle of the normal.
TEST(VertexMove, ChangesAreThoseOfTheMesh)
{
  Random random(5, 0);
  for (int i = 0; i < 200; ++i)
  {
    Mesh mesh = makeBipyramid(3 + random.below(9));
    const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
    const Vector4 position = mesh.position(v) + randomPoint(random, 0.3f);
    const double area = areaOf(mesh);
    const double volume = signedVolume(mesh);
    const Eigen::Vector3d normal = normalAt(mesh, v);
    const double areaChanged = areaChange(mesh, v, position);
    const double volumeChanged = volumeChange(mesh, v, position);
    const double normalChanged = normalChange(mesh, v, position);
    mesh.setPosition(v, position);
    EXPECT_NEAR(areaChanged, std::abs(areaOf(mesh) - area), 1e-5);
    EXPECT_NEAR(volumeChanged, std::abs(signedVolume(mesh) - volume), 1e-5);
    EXPECT_NEAR(normalChanged, 1. - normal.dot(normalAt(mesh, v)), 1e-4);
  }
}

/// The mean gain of random moves once the averages are known.
double meanGain(const Parameters& parameters, bool inList)
{
  WinGain gain(parameters);
  if (inList)
  {
    gain.enterList();
  }
  const Mesh mesh = makeBipyramid(6);
  Random random(1, 0);
  double sum = 0.;
  constexpr int Moves = 20000;
  for (int i = 0; i < 2 * Moves; ++i)
  {
    gain.beginBatch(1);
    const VertexIndex v = random.below(std::uint32_t(mesh.indexEnd()));
    const double one = gain.ofMove(mesh, v, mesh.position(v) + randomPoint(random, 0.01f));
    sum += i < Moves ? 0. : one;
  }
  return sum / Moves;
}

// Whatever measures a move, a win is worth 1 on average, so that jumps are as long on average.
TEST(WinGain, IsOneOnAverage)
{
  Parameters parameters;
  parameters.gainLimit = 0.;
  for (const Jump jump :
    { Jump::Constant, Jump::NormalActivity, Jump::AreaChange, Jump::VolumeChange, Jump::Weighted })
  {
    parameters.jump = jump;
    EXPECT_NEAR(meanGain(parameters, true), 1., 0.05) << int(jump);
  }
  parameters.variant = Variant::NormalBased;
  EXPECT_NEAR(meanGain(parameters, false), 1., 0.05);
}

// In the normal-based variant a move in the plane of the triangles is worth nothing, one that turns
// the normal is; and no more than the limit.
TEST(WinGain, FollowsTheNormal)
{
  Parameters parameters;
  parameters.variant = Variant::NormalBased;
  parameters.changeWindow = 100;
  WinGain gain(parameters);
  const Mesh mesh = makeFan(6);
  const Vector4 out(0.f, 0.01f, 0.01f);
  for (int i = 0; i < 200; ++i)
  {
    gain.beginBatch(1);
    gain.ofMove(mesh, 1, mesh.position(1) + out);
  }
  gain.beginBatch(1);
  EXPECT_NEAR(gain.ofMove(mesh, 0, Vector4(0.1f, 0.1f, 0.f)), 0., 1e-3);
  EXPECT_NEAR(gain.ofMove(mesh, 1, mesh.position(1) + out), 1., 1e-3);
  EXPECT_NEAR(gain.ofMove(mesh, 1, mesh.position(1) + 50.f * out), parameters.gainLimit, 1e-3);
}
}
}
