// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/PackedGrid.h"
#include "mesh/Refinement.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
using Draw = std::function<Vector4(Random&)>;

Vector4 inCube(Random& random, float width)
{
  const auto draw = [&] { return width * float(random.uniform() - 0.5); };
  const float x = draw(), y = draw();
  return { x, y, draw() };
}

/// Vertices at drawn positions; how they are joined does not matter to a grid.
Mesh meshAt(std::size_t count, const Draw& draw)
{
  Mesh mesh = Mesh::tetrahedron(Vector4(), 0.5f);
  refine(mesh, count, goOn);
  Random random(1);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.setPosition(v, draw(random));
  }
  return mesh;
}

VertexIndex closestOfAll(const Mesh& mesh, Vector4 point)
{
  VertexIndex best = NoVertex;
  float least = std::numeric_limits<float>::infinity();
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const float distance = squaredNorm(mesh.position(v) - point);
    if (mesh.isAlive(v) && distance < least)
    {
      least = distance;
      best = v;
    }
  }
  return best;
}

void expectClosest(const Mesh& mesh, const PackedGrid& grid, const Draw& draw)
{
  Random random(2);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector4 point = draw(random);
    ASSERT_EQ(grid.closest(point), closestOfAll(mesh, point)) << i;
  }
}

const Vector4 Corner(0.5f, 0.5f, 0.5f);
}

// The closest vertex is found, wherever vertices and points lie: in the box, beyond it, all in one cell, or many in
// one place, of which the lowest index counts. On any number of threads.
TEST(PackedGrid, FindsTheClosest)
{
  const std::vector<Draw> draws{ [](Random& random) { return inCube(random, 1.f); },
    [](Random& random) { return inCube(random, 3.f); },
    [](Random& random) { return inCube(random, random.uniform() < 0.9 ? 1e-4f : 1.f); },
    [](Random& random)
    { return Vector4(float(random.below(4)) / 4.f, float(random.below(4)) / 4.f, 0.f); } };
  for (const Draw& vertices : draws)
  {
    const Mesh mesh = meshAt(3000, vertices);
    for (const unsigned threads : { 1u, 3u })
    {
      for (const float width : { 0.02f, 0.1f, 2.f })
      {
        PackedGrid grid;
        grid.build(mesh, -1.f * Corner, Corner, width, ThreadPool(threads));
        for (const Draw& points : draws)
        {
          expectClosest(mesh, grid, points);
        }
      }
    }
  }
}

// It may be built again, of another mesh; erased vertices are not found.
TEST(PackedGrid, IsBuiltAgain)
{
  const Draw draw = [](Random& random) { return inCube(random, 1.f); };
  Mesh mesh = meshAt(2000, draw);
  PackedGrid grid;
  grid.build(mesh, -1.f * Corner, Corner, 0.05f);
  std::size_t removed = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd() && removed < 500; ++v)
  {
    const VertexIndex kept = mesh.ring(v).front();
    if (mesh.canCollapse(v, kept))
    {
      mesh.collapse(v, kept);
      ++removed;
    }
  }
  ASSERT_EQ(removed, 500u);
  grid.build(mesh, -1.f * Corner, Corner, 0.05f);
  expectClosest(mesh, grid, draw);
}

// Where most vertices are in one cell, it says so.
TEST(PackedGrid, TellsCrowds)
{
  PackedGrid grid;
  const Mesh spread = meshAt(3000, [](Random& random) { return inCube(random, 1.f); });
  grid.build(spread, -1.f * Corner, Corner, 0.05f);
  EXPECT_LT(grid.mostInCell(), 10u);
  const Mesh crowd = meshAt(
    3000, [](Random& random) { return inCube(random, random.uniform() < 0.9 ? 1e-4f : 1.f); });
  grid.build(crowd, -1.f * Corner, Corner, 0.05f);
  EXPECT_GT(grid.mostInCell(), 300u);
}
}
