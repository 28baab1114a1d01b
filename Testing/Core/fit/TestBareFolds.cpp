// SPDX-License-Identifier: BSD-3-Clause
#include "fit/BareFolds.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "PlacedCloud.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
std::vector<Eigen::Vector3d> pointsOn(const TriangleMesh& surface)
{
  CloudOptions options;
  options.count = 30000;
  return generateCloud(surface, options);
}

/// Which vertices of a surface are collapsed, given these points.
std::vector<VertexIndex> collapsedOf(
  const TriangleMesh& surface, const std::vector<Eigen::Vector3d>& points)
{
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(surface, cloud);
  const PlacedCloud placed(cloud, mesh);
  const ChangedVertices changed = collapseBareFolds(mesh, placed.samples, 0.);
  EXPECT_EQ(defectOf(mesh), "");
  std::vector<VertexIndex> collapsed;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_TRUE(mesh.isAlive(changed.alive(mesh, v)));
    if (!mesh.isAlive(v))
    {
      collapsed.push_back(v);
    }
  }
  return collapsed;
}
}

// Promise: a spike that no sample supports goes, outwards and inwards; nothing else does.
TEST(BareFolds, TakesSpikesAway)
{
  const std::vector<Eigen::Vector3d> points = pointsOn(makeSphere(48));
  const VertexIndex spike = 100;
  for (const double height : { 1.6, 0.5 })
  {
    TriangleMesh sphere = makeSphere(12);
    sphere.points[spike] *= height;
    EXPECT_EQ(collapsedOf(sphere, points), std::vector<VertexIndex>{ spike }) << height;
  }
}

// Promise: edges with samples stay, and so does a closed gap of the data over an edge.
TEST(BareFolds, LeavesEdgesAndGaps)
{
  const TriangleMesh cube = makeCube(10);
  std::vector<Eigen::Vector3d> points = pointsOn(cube);
  EXPECT_TRUE(collapsedOf(cube, points).empty());
  const Eigen::Vector3d onEdge(0., 0.5, 0.5);
  const std::size_t erased = std::erase_if(
    points, [&](const Eigen::Vector3d& point) { return (point - onEdge).norm() < 0.25; });
  EXPECT_GT(erased, 500u);
  EXPECT_TRUE(collapsedOf(cube, points).empty());
}
}
