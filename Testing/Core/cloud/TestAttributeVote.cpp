// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/AttributeVote.h"

#include "cloud/MeshBuilder.h"
#include "cloud/NearestMarked.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace neuralmesh::testing
{
namespace
{
std::vector<std::uint32_t> voted(
  const PointCloud& cloud, const Mesh& mesh, const std::vector<std::uint32_t>& labels)
{
  return voteForLabels(CloudPlaces(cloud, mesh, goOn), labels);
}
}

// Each half of a sphere has its label, but for the vertices next to the border; so does a gap.
TEST(AttributeVote, Halves)
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  std::erase_if(points, [](const Eigen::Vector3d& p) { return p.x() > 0.9; });
  const PointCloud cloud(points);
  const Mesh mesh = buildMesh(makeSphere(16), cloud);
  std::vector<std::uint32_t> labels;
  for (const Vector4 point : cloud.points())
  {
    labels.push_back(point[2] > 0.f ? 7 : 3);
  }
  const std::vector<std::uint32_t> result = voted(cloud, mesh, labels);
  const float edge = 0.04f;
  std::size_t sevens = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const float height = mesh.position(v)[2];
    sevens += result[v] == 7 ? 1 : 0;
    if (std::abs(height) > edge && mesh.position(v)[0] < 0.2f)
    {
      ASSERT_EQ(result[v], height > 0.f ? 7u : 3u) << "vertex " << v;
    }
    ASSERT_TRUE(result[v] == 7 || result[v] == 3);
  }
  EXPECT_NEAR(double(sevens), 0.5 * double(mesh.indexEnd()), 0.05 * double(mesh.indexEnd()));
}

// The label of the most weight wins; of equal ones the lowest; weights of points count.
TEST(AttributeVote, MostWeight)
{
  // Around the fan's centre, each on the middle of a spoke: half for the centre.
  const std::vector<Eigen::Vector3d> points{ { 0.5, 0., 0. }, { -0.5, 0., 0. }, { 0., 0.5, 0. },
    { 0., -0.5, 0. } };
  const std::vector<std::uint32_t> byOrigin{ 9, 4, 4, 9 };
  for (const auto& [weights, winner] : { std::pair(std::vector<double>{ 1., 1., 1., 1. }, 4u),
         std::pair(std::vector<double>{ 2., 1., 1., 1. }, 9u),
         std::pair(std::vector<double>{ 1., 3., 1., 1. }, 4u) })
  {
    const PointCloud cloud(points, weights, true);
    Mesh mesh = makeFan(4);
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      mesh.setPosition(v, cloud.fromInput(mesh.position(v).toDouble()));
    }
    std::vector<std::uint32_t> labels;
    for (const std::uint32_t origin : cloud.origins())
    {
      labels.push_back(byOrigin[origin]);
    }
    EXPECT_EQ(voted(cloud, mesh, labels)[0], winner);
  }
}

// If it is told to end, no point has a place.
TEST(AttributeVote, EndsEarly)
{
  const Mesh mesh = buildMesh(makeSphere(4), cleanSphere());
  const CloudPlaces places(cleanSphere(), mesh, [](double) { return false; });
  const std::vector<std::uint32_t> labels(cleanSphere().points().size());
  for (const std::uint32_t label : voteForLabels(places, labels))
  {
    EXPECT_EQ(label, NoLabel);
  }
}

// The nearest marked vertex is that of the fewest edges, within the component.
TEST(NearestMarked, FewestEdges)
{
  const Mesh fan = makeFan(6);
  std::vector<bool> marked(fan.indexEnd());
  EXPECT_EQ(nearestMarked(fan, marked), std::vector<VertexIndex>(fan.indexEnd(), NoVertex));
  const VertexIndex first = fan.ring(0)[0];
  marked[first] = true;
  EXPECT_EQ(nearestMarked(fan, marked), std::vector<VertexIndex>(fan.indexEnd(), first));
  const VertexIndex opposite = fan.ring(0)[3];
  marked[opposite] = true;
  const std::vector<VertexIndex> nearest = nearestMarked(fan, marked);
  EXPECT_EQ(nearest[fan.ring(0)[1]], first);
  EXPECT_EQ(nearest[fan.ring(0)[2]], opposite);
  EXPECT_EQ(nearest[opposite], opposite);
}

// Points of a kind vote together, and the first of them in the input stands for it.
TEST(AttributeVote, Kinds)
{
  const std::vector<Eigen::Vector3d> points = sphereCloud();
  const PointCloud cloud(points, {}, true);
  const Mesh mesh = buildMesh(makeSphere(16), cloud);
  const auto kindOf = [&](std::uint32_t point) { return points[point].z() > 0. ? "up" : "down"; };
  std::array<std::uint32_t, 2> firsts{ NoLabel, NoLabel };
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    std::uint32_t& first = firsts[points[i].z() > 0. ? 1 : 0];
    first = std::min(first, i);
  }
  const auto result = voteForKinds(CloudPlaces(cloud, mesh, goOn), kindOf);
  ASSERT_EQ(result.size(), mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const double height = cloud.toInput(mesh.position(v)).z();
    if (std::abs(height) > 0.1)
    {
      EXPECT_EQ(result[v], firsts[height > 0. ? 1 : 0]) << "vertex " << v;
    }
  }
}
}
