// SPDX-License-Identifier: BSD-3-Clause
#include "AnyOperation.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace neuralmesh::testing
{
namespace
{
using Place = std::array<float, 3>;

Place placeOf(const Mesh& mesh, VertexIndex v)
{
  const Vector4 p = mesh.position(v);
  return { p[0], p[1], p[2] };
}

/// A mesh with a property of each kind.
struct Marked
{
  explicit Marked(Mesh start)
    : mesh(std::move(start))
    , copied(mesh.addProperty(0., OnSplit::Copy))
    , begun(mesh.addProperty(std::uint8_t(7), OnSplit::Begin))
  {
  }

  Mesh mesh;
  VertexProperty<double> copied;
  VertexProperty<std::uint8_t> begun;
};
}

// Whatever is done to a mesh, a vertex that is where it was has the values that it had; one that is
// new has those that its property was declared with.
TEST(VertexProperties, FollowAnyOperation)
{
  Random random(3);
  Marked marked(makeRandomMesh(30, random));
  for (int i = 0; i < 20000; ++i)
  {
    if (marked.mesh.vertexCount() < 5 || marked.mesh.vertexCount() > 60)
    {
      marked = Marked(makeRandomMesh(10 + random.below(20), random));
    }
    Mesh& mesh = marked.mesh;
    std::map<Place, std::pair<double, int>> before;
    std::size_t alive = 0;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (mesh.isAlive(v))
      {
        ++alive;
        mesh.values(marked.copied)[v] = random.uniform();
        mesh.values(marked.begun)[v] = std::uint8_t(random.below(7));
        before[placeOf(mesh, v)] = { mesh.values(marked.copied)[v], mesh.values(marked.begun)[v] };
      }
    }
    if (before.size() < alive)
    {
      marked = Marked(makeRandomMesh(20, random)); // two are at the same place
      continue;
    }
    const auto countAt = [&mesh](const Place& place)
    {
      std::size_t count = 0;
      for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
      {
        count += mesh.isAlive(v) && placeOf(mesh, v) == place ? 1 : 0;
      }
      return count;
    };
    const std::string_view operation = AnyOperation<Random>(mesh, random).operate().operation;
    ASSERT_EQ(mesh.values(marked.copied).size(), mesh.indexEnd()) << operation;
    ASSERT_EQ(mesh.values(marked.begun).size(), mesh.indexEnd()) << operation;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      const double copied = mesh.values(marked.copied)[v];
      const int begun = mesh.values(marked.begun)[v];
      const auto there = before.find(placeOf(mesh, v));
      if (!mesh.isAlive(v))
      {
        continue;
      }
      if (there != before.end() && countAt(there->first) == 1)
      {
        ASSERT_EQ(copied, there->second.first) << operation;
        ASSERT_EQ(begun, there->second.second) << operation;
      }
      ASSERT_TRUE(std::any_of(before.begin(), before.end(),
        [&](const auto& known) { return known.second.first == copied; }))
        << operation;
      ASSERT_LE(begun, 7) << operation;
    }
  }
}

// A split copies a value, or begins anew, as its property was declared.
TEST(VertexProperties, SplitsCopyOrBegin)
{
  Marked marked(Mesh::tetrahedron({}, 1.f));
  marked.mesh.values(marked.copied)[2] = 2.5;
  marked.mesh.values(marked.begun)[2] = 1;
  const VertexIndex added = marked.mesh.split(2, 0, 2, Vector4());
  EXPECT_EQ(marked.mesh.values(marked.copied)[added], 2.5);
  EXPECT_EQ(marked.mesh.values(marked.begun)[added], 7);
  EXPECT_EQ(marked.mesh.values(marked.begun)[2], 1);
}

// A copy of a mesh has values of its own.
TEST(VertexProperties, CopiesAreIndependent)
{
  Marked marked(Mesh::tetrahedron({}, 1.f));
  Mesh copy = marked.mesh;
  copy.values(marked.copied)[0] = 1.;
  EXPECT_EQ(marked.mesh.values(marked.copied)[0], 0.);
  copy.split(0, 0, 2, Vector4());
  EXPECT_EQ(copy.values(marked.copied).size(), 5u);
  EXPECT_EQ(marked.mesh.values(marked.copied).size(), 4u);
}
}
