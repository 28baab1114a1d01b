// SPDX-License-Identifier: BSD-3-Clause
#include "fit/TrianglesAround.h"

#include "Shapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace neuralmesh::testing
{
// Promise: the triangles at some vertices come out once each, their least corner first, in the order of the corners.
TEST(TrianglesAround, EachOnceInOrder)
{
  const Mesh mesh = meshOf(makeCube(3));
  TrianglesAround around;
  for (const VertexIndex center : { 0u, 7u, 20u })
  {
    std::set<Triangle> expected;
    around.clear();
    for (const VertexIndex v : mesh.ring(center))
    {
      around.add(mesh, v);
      mesh.forEachTriangle(
        [&](VertexIndex a, VertexIndex b, VertexIndex c)
        {
          Triangle triangle{ a, b, c };
          std::rotate(
            triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
          if (std::find(triangle.begin(), triangle.end(), v) != triangle.end())
          {
            expected.insert(triangle);
          }
        });
    }
    around.finish();
    EXPECT_EQ(around.triangles(), std::vector<Triangle>(expected.begin(), expected.end()));
  }
}
}
