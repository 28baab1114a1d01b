// SPDX-License-Identifier: BSD-3-Clause
#include "AnyOperation.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <map>

namespace neuralmesh::testing
{
namespace
{
#ifdef NDEBUG
constexpr int Million = 1'000'000;
#else
// With assertions, and sanitizers most of the time, each takes as long as ten.
constexpr int Million = 100'000;
#endif
constexpr std::size_t MostVertices = 40;
constexpr std::size_t FewestVertices = 5;

/// The rings of a mesh, to compare it with what it was.
std::vector<std::vector<VertexIndex>> ringsOf(const Mesh& mesh)
{
  std::vector<std::vector<VertexIndex>> rings;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    rings.emplace_back(mesh.ring(v).begin(), mesh.ring(v).end());
    rings.back().push_back(mesh.ring(v).isOpen());
  }
  return rings;
}

/// After every one of so many operations, legal or not, with whatever arguments, the mesh is an
/// oriented 2-manifold, its rings agree with each other, and what was refused has left no trace.
void expectManifoldAfter(int operations, std::uint64_t seed)
{
  Random random(seed);
  Mesh mesh = Mesh::tetrahedron({}, 1.f);
  std::map<std::string_view, std::pair<int, int>> counts;
  AnyOperation<Random> any(mesh, random);
  for (int i = 0; i < operations; ++i)
  {
    if (mesh.vertexCount() < FewestVertices || mesh.vertexCount() > MostVertices)
    {
      mesh = makeRandomMesh(10 + random.below(20), random);
    }
    const auto before = ringsOf(mesh);
    const auto [operation, done] = any.operate();
    ASSERT_EQ(defectOf(mesh), "") << "after operation " << i << ", " << operation;
    if (!done)
    {
      ASSERT_EQ(ringsOf(mesh), before) << "operation " << i << ", " << operation;
    }
    ++(done ? counts[operation].first : counts[operation].second);
  }
  for (const auto& [operation, count] : counts)
  {
    EXPECT_GT(count.first, operations / 5000) << operation;
  }
  for (const char* operation : { "split", "edge split", "half-edge collapse", "full-edge collapse",
         "vertex delete", "flip", "removal", "fill", "join" })
  {
    EXPECT_GT(counts[operation].second, operations / 5000) << operation;
  }
}
}

TEST(AnyOperation, KeepsTheManifold) { expectManifoldAfter(20'000, 2); }

TEST(AnyOperation, MillionKeepTheManifold) { expectManifoldAfter(Million, 1); }
}
