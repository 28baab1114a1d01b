// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/StoredMesh.h"

#include "base/ThreadPool.h"
#include "mesh/CompactRings.h"

#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
void expectSame(const Mesh& mesh, const Mesh& expected)
{
  ASSERT_EQ(mesh.indexEnd(), expected.indexEnd());
  EXPECT_EQ(mesh.vertexCount(), expected.vertexCount());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Ring &ring = mesh.ring(v), &other = expected.ring(v);
    ASSERT_EQ(ring.isOpen(), other.isOpen());
    ASSERT_TRUE(std::equal(ring.begin(), ring.end(), other.begin(), other.end()));
    ASSERT_TRUE(isAt(mesh.position(v), expected.position(v)));
  }
}

/// Closed and open ones, with erased vertices, and one with indices far from each other in several blocks.
std::vector<Mesh> meshesToStore()
{
  Random random(1);
  std::vector<Mesh> meshes;
  for (const bool isOpen : { false, true })
  {
    Mesh& mesh = meshes.emplace_back(makeRandomMesh(500, random));
    if (isOpen)
    {
      tear(mesh, 20, random);
    }
  }
  Mesh& large = meshes.emplace_back(meshOf(makeSphere(60)));
  std::vector<VertexIndex> order(large.indexEnd());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = VertexIndex(i);
  }
  for (std::size_t i = order.size() - 1; i > 0; --i)
  {
    std::swap(order[i], order[random.below(std::uint32_t(i + 1))]);
  }
  large.renumber(order);
  return meshes;
}
}

// A mesh that was laid aside comes back as it was, with its properties, on any number of threads.
TEST(StoredMesh, ComesBackAsItWas)
{
  for (Mesh& mesh : meshesToStore())
  {
    const auto property = mesh.addProperty(0.f, OnSplit::Copy);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      mesh.values(property)[v] = float(v);
    }
    const ThreadPool threads(3);
    const StoredMesh stored(mesh, threads);
    EXPECT_EQ(stored.vertexCount(), mesh.vertexCount());
    for (const Mesh& again : { stored.mesh(), stored.mesh(threads) })
    {
      expectSame(again, mesh);
      EXPECT_EQ(defectOf(again), defectOf(mesh));
      const auto values = again.values(property), before = std::as_const(mesh).values(property);
      EXPECT_TRUE(std::equal(values.begin(), values.end(), before.begin(), before.end()));
    }
  }
}

// Rings that were released are restored from compact ones.
TEST(StoredMesh, RingsAreRestored)
{
  for (Mesh& mesh : meshesToStore())
  {
    const Mesh before = mesh;
    const ThreadPool threads(3);
    const CompactRings rings(mesh, threads);
    {
      const RingsReleased released(mesh, rings, threads);
    }
    expectSame(mesh, before);
  }
}
}
