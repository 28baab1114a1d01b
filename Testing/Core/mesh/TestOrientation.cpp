// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Orientation.h"

#include "MeshTools.h"

#include <gtest/gtest.h>

#include <numeric>

namespace neuralmesh::testing
{
namespace
{
std::vector<VertexIndex> allVertices(const Mesh& mesh)
{
  std::vector<VertexIndex> all(mesh.indexEnd());
  std::iota(all.begin(), all.end(), VertexIndex(0));
  return all;
}
}

// A closed mesh that is inside out is turned, wherever it lies; one that is not stays.
TEST(Orientation, TurnsClosedMeshOutwards)
{
  for (const Vector4 center : { Vector4(), Vector4(50.f, -20.f, 3.f) })
  {
    Mesh mesh = Mesh::tetrahedron(center, 1.f);
    const auto outwards = canonical(trianglesOf(mesh));
    EXPECT_EQ(orientOutwards(mesh), 0u);
    EXPECT_EQ(canonical(trianglesOf(mesh)), outwards);
    mesh.reverseOrientation(allVertices(mesh));
    ASSERT_LT(signedVolume(mesh), 0.);
    EXPECT_EQ(orientOutwards(mesh), 1u);
    EXPECT_EQ(canonical(trianglesOf(mesh)), outwards);
    EXPECT_EQ(defectOf(mesh), "");
  }
}

// An open mesh is turned by the volume that it encloses once its loop is closed.
TEST(Orientation, TurnsOpenMeshOutwards)
{
  Mesh mesh = makeBipyramid(6);
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  const auto outwards = canonical(trianglesOf(mesh));
  EXPECT_EQ(orientOutwards(mesh), 0u);
  mesh.reverseOrientation(allVertices(mesh));
  EXPECT_EQ(orientOutwards(mesh), 1u);
  EXPECT_EQ(canonical(trianglesOf(mesh)), outwards);
}

// A flat mesh has no outside: it stays as it is.
TEST(Orientation, LeavesFlatMeshes)
{
  for (const float height : { 0.f, 0.01f })
  {
    Mesh mesh = makeFan(12);
    mesh.setPosition(0, Vector4(0.f, 0.f, height));
    for (int i = 0; i < 2; ++i)
    {
      mesh.reverseOrientation(allVertices(mesh));
      const auto before = canonical(trianglesOf(mesh));
      EXPECT_EQ(orientOutwards(mesh), 0u);
      EXPECT_EQ(canonical(trianglesOf(mesh)), before);
    }
  }
}

// A piece, here a pyramid without its base, knows its area, its volume, and the area of the base.
TEST(Orientation, PiecesAreMeasured)
{
  Mesh mesh = makeFan(15);
  mesh.setPosition(0, Vector4(0.f, 0.f, 1.f));
  const std::vector<Piece> pieces = findPieces(mesh);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_FALSE(pieces[0].isClosed);
  EXPECT_EQ(pieces[0].vertices.size(), mesh.vertexCount());
  const double sine = std::sin(std::numbers::pi / 15.), cosine = std::cos(std::numbers::pi / 15.);
  EXPECT_NEAR(pieces[0].area, 15. * sine * std::sqrt(1. + cosine * cosine), 1e-6);
  EXPECT_NEAR(pieces[0].closingArea, 15. * sine * cosine, 1e-6);
  EXPECT_NEAR(pieces[0].volume, 5. * sine * cosine, 1e-6);
}
}
