// SPDX-License-Identifier: BSD-3-Clause
#include "base/Archive.h"
#include "BoundaryTools.h"
#include "learn/ExactOrder.h"
#include "learn/ListOrder.h"
#include "learn/NeuralMesh.h"
#include "MeshTools.h"

#include <gtest/gtest.h>

#include <set>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t VertexLimit = 300;

NeuralMesh tetrahedron()
{
  return { Mesh::tetrahedron({}, 0.1f), std::make_unique<ExactOrder>(4), Vector4(-1.f, -1.f, -1.f),
    Vector4(1.f, 1.f, 1.f), VertexLimit };
}

/// What is at odds in it, in words; nothing if all is well.
std::string disagreementIn(const NeuralMesh& neuralMesh, Random& random)
{
  const Mesh& mesh = neuralMesh.mesh();
  if (const std::string defect = defectOf(mesh); !defect.empty())
  {
    return defect;
  }
  const std::vector<VertexIndex> vertices = neuralMesh.vertices();
  for (int i = 0; i < 20; ++i)
  {
    // The closest vertex, by looking at all.
    const Vector4 sample = randomPoint(random, 1.f);
    float least = std::numeric_limits<float>::max();
    for (const VertexIndex v : vertices)
    {
      least = std::min(least, squaredNorm(mesh.position(v) - sample));
    }
    const VertexIndex winner = neuralMesh.winner(sample);
    if (!mesh.isAlive(winner) || squaredNorm(mesh.position(winner) - sample) != least)
    {
      return "another vertex is closer";
    }
  }
  if (!mesh.isAlive(neuralMesh.top()))
  {
    return "the top is no vertex";
  }
  for (const VertexIndex v : vertices)
  {
    if (neuralMesh.order().activity(v) > neuralMesh.order().activity(neuralMesh.top()))
    {
      return "another vertex is more active than the top";
    }
  }
  return {};
}
}

// What another learner knew of the vertices of its mesh is no part of one that begins from it: what is read
// from a checkpoint would be in other places.
TEST(NeuralMesh, TakesNoPropertiesOver)
{
  const auto checksumFrom = [](Mesh mesh)
  {
    NeuralMesh neuralMesh(std::move(mesh), std::make_unique<ExactOrder>(4),
      Vector4(-1.f, -1.f, -1.f), Vector4(1.f, 1.f, 1.f), VertexLimit);
    neuralMesh.addProperty(1.f, OnSplit::Copy);
    Archive archive;
    archive(neuralMesh);
    archive.finish();
    return archive.checksum();
  };
  Mesh used = Mesh::tetrahedron({}, 0.1f);
  used.addProperty(std::uint8_t(7), OnSplit::Begin);
  EXPECT_EQ(checksumFrom(std::move(used)), checksumFrom(Mesh::tetrahedron({}, 0.1f)));
}

// After each call of a random sequence of them the mesh is a manifold, its closest vertex is found,
// and the order knows its vertices and no other.
TEST(NeuralMesh, AllAgreeAfterEachCall)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    Random random(seed);
    NeuralMesh mesh = tetrahedron();
    ASSERT_EQ(disagreementIn(mesh, random), "");
    mesh.traceBoundaries();
    Parameters parameters;
    parameters.triangleRemovalFactor = 2.;
    const TopologyLearning mended(parameters);
    parameters.topologyRules = TopologyRules::Thesis;
    const TopologyLearning tearing(parameters); // closes nothing of what it tears
    std::set<std::string> done;
    for (int i = 0; i < 4000; ++i)
    {
      const std::vector<VertexIndex> vertices = mesh.vertices();
      const VertexIndex any = vertices[random.below(std::uint32_t(vertices.size()))];
      const unsigned kind = random.below(100);
      std::string call;
      if (kind < 30 && mesh.vertexCount() < VertexLimit)
      {
        call = "split";
        const VertexIndex top = mesh.top();
        if (const auto plan = planVertexSplit(mesh.mesh(), top))
        {
          const VertexIndex added = mesh.split(top, *plan);
          mesh.flipEdgesAround(added);
        }
        else
        {
          mesh.demoteTop();
        }
      }
      else if (kind < 40)
      {
        call = "collapse";
        const VertexIndex bottom = mesh.bottom();
        const VertexIndex kept = mesh.planCollapse(bottom);
        const Ring polygon = mesh.mesh().ring(bottom);
        if (kept == NoVertex)
        {
          mesh.promoteBottom();
        }
        else
        {
          mesh.collapse(bottom, kept);
          mesh.triangulateAnew(polygon, kept);
        }
      }
      else if (kind < 70)
      {
        call = "win";
        mesh.move(any, randomPoint(random, 0.5f));
        mesh.smoothRing(any, 0.3f, BoundarySmoothing::Along);
        mesh.win(any, 1., 0.999);
      }
      else if (kind < 80)
      {
        call = "pass";
        mesh.pass(0.99);
        mesh.releaseErased();
      }
      else if (kind < 85)
      {
        call = "topology";
        mesh.learnTopology(random.below(2) == 0 ? mended : tearing);
      }
      else if (kind < 90 && mended.canRemoveStar(mesh.mesh(), any))
      {
        call = "removal of a star";
        mesh.removeStar(any, mended);
      }
      else if (kind < 95)
      {
        call = "compact";
        mesh.compact(Executor::sequential());
        EXPECT_EQ(mesh.mesh().indexEnd(), mesh.vertexCount());
      }
      else
      {
        call = "order";
        mesh.replaceOrder(
          [&](std::span<const VertexIndex> laziestFirst)
          {
            EXPECT_EQ(laziestFirst.size(), mesh.vertexCount());
            EXPECT_EQ(std::set<VertexIndex>(laziestFirst.begin(), laziestFirst.end()).size(),
              laziestFirst.size());
            return std::make_unique<ListOrder>(laziestFirst, 0.3, seed);
          });
      }
      done.insert(call);
      ASSERT_EQ(disagreementIn(mesh, random), "") << "after call " << i << ", " << call;
    }
    EXPECT_EQ(done,
      (std::set<std::string>{
        "split", "collapse", "win", "pass", "topology", "removal of a star", "compact", "order" }));
  }
}

// A property follows a split and a renumbering.
TEST(NeuralMesh, PropertiesFollow)
{
  NeuralMesh mesh = tetrahedron();
  const VertexProperty<double> x = mesh.addProperty(0., OnSplit::Copy);
  for (const VertexIndex v : mesh.vertices())
  {
    mesh.values(x)[v] = mesh.mesh().position(v)[0];
  }
  const auto plan = planVertexSplit(mesh.mesh(), 1);
  ASSERT_TRUE(plan);
  const VertexIndex added = mesh.split(1, *plan);
  EXPECT_EQ(mesh.values(x)[added], mesh.values(x)[1]);
  mesh.values(x)[added] = mesh.mesh().position(added)[0];
  mesh.compact(Executor::sequential());
  for (const VertexIndex v : mesh.vertices())
  {
    EXPECT_EQ(mesh.values(x)[v], mesh.mesh().position(v)[0]);
  }
}

// All vertices move with a map of the space, and are found where they are then.
TEST(NeuralMesh, AllMove)
{
  Random random(5);
  NeuralMesh mesh = tetrahedron();
  mesh.moveAll(Vector4(-3.f, -3.f, -3.f), Vector4(3.f, 3.f, 3.f),
    [](Vector4 position) { return 3.f * position + Vector4(0.5f, 0.f, 0.f); });
  EXPECT_EQ(disagreementIn(mesh, random), "");
}
}
