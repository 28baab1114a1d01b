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

// A mesh with a boundary has no outside: it stays as it is.
TEST(Orientation, LeavesOpenMeshes)
{
  Mesh mesh = makeBipyramid(6);
  mesh.reverseOrientation(allVertices(mesh));
  removeTriangle(mesh, { 0, mesh.ring(0)[0], mesh.ring(0)[1] });
  const auto before = canonical(trianglesOf(mesh));
  EXPECT_EQ(orientOutwards(mesh), 0u);
  EXPECT_EQ(canonical(trianglesOf(mesh)), before);
}
}
