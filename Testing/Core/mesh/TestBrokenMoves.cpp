// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BrokenMoves.h"

#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
PackedVectors positionsOf(const Mesh& mesh)
{
  PackedVectors positions(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    positions.set(v, mesh.position(v));
  }
  return positions;
}

/// With a vertex that sticks out on the other side.
Mesh pierced(Mesh mesh)
{
  Vector4 center;
  for (const Vector4 position : mesh.positions())
  {
    center += 1.f / float(mesh.vertexCount()) * position;
  }
  mesh.setPosition(0, center - 1.5f * (mesh.position(0) - center));
  return mesh;
}

AfterBrokenMoves takeBack(Mesh& mesh, const PackedVectors& before)
{
  return takeBackBrokenMoves(mesh, before, [](double) { return true; });
}
}

TEST(BrokenMoves, GoBackAndAreTold)
{
  const Mesh sphere = meshOf(makeSphere(16));
  Mesh mesh = pierced(sphere);
  EXPECT_EQ(takeBack(mesh, positionsOf(sphere)), AfterBrokenMoves::Sound);
  EXPECT_EQ(squaredNorm(mesh.position(0) - sphere.position(0)), 0.f);
}

TEST(BrokenMoves, AreNotThereWhereNothingIsBroken)
{
  Mesh mesh = meshOf(makeSphere(16));
  EXPECT_EQ(takeBack(mesh, positionsOf(mesh)), AfterBrokenMoves::Untouched);
}

TEST(BrokenMoves, AreNotThoseThatWereBrokenBefore)
{
  Mesh mesh = pierced(meshOf(makeSphere(16)));
  EXPECT_EQ(takeBack(mesh, positionsOf(mesh)), AfterBrokenMoves::Broken);
}
}
