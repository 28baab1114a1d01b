// SPDX-License-Identifier: BSD-3-Clause
#include "fit/LocalSpacing.h"

#include "cloud/MeshBuilder.h"
#include "OpenShapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace neuralmesh::testing
{
// Around a vertex, samples are as far from each other as their number on the triangles there has it,
// and edges are as long as they are.
TEST(LocalSpacing, TellsSparseFromDense)
{
  const TriangleMesh grid = makeGrid(20);
  const PointCloud cloud(grid.points);
  const Mesh mesh = buildMesh(grid, cloud);
  std::vector<PlaceOnMesh> places;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const bool isDense = cloud.toInput(mesh.position(a)).x() < 0.5;
      for (int i = 0; i < (isDense ? 16 : 1); ++i)
      {
        places.push_back({ { a, b, c }, 0.f, 0.f, 0.f });
      }
    });
  const LocalSpacing spacing(mesh, places);
  const double areaOfTriangle = 0.5 / (20. * 20.);
  for (const PlaceOnMesh& place : places)
  {
    const double x = cloud.toInput(mesh.position(place.triangle[0])).x();
    const double edge = cloud.unit() * double(spacing.edgeAt(place));
    EXPECT_GT(edge, 1. / 20.);
    EXPECT_LT(edge, std::sqrt(2.) / 20.);
    if (std::abs(x - 0.5) > 0.2)
    {
      const double expected = std::sqrt(areaOfTriangle / (x < 0.5 ? 16. : 1.));
      EXPECT_NEAR(cloud.unit() * double(spacing.samplesAt(place)), expected, 1e-3 * expected);
    }
  }
}
}
