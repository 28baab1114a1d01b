// SPDX-License-Identifier: BSD-3-Clause
#include "fit/BareFolds.h"

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "PlacedCloud.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

/// Which vertices are collapsed, given these points.
std::vector<VertexIndex> collapsedOf(Mesh& mesh, const PointCloud& cloud)
{
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

std::vector<VertexIndex> collapsedOf(
  const TriangleMesh& surface, const std::vector<Eigen::Vector3d>& points)
{
  const PointCloud cloud(points);
  Mesh mesh = buildMesh(surface, cloud);
  return collapsedOf(mesh, cloud);
}

VertexIndex indexAt(const TriangleMesh& surface, const Eigen::Vector3d& place)
{
  const auto found = std::min_element(surface.points.begin(), surface.points.end(),
    [&](const auto& a, const auto& b) { return (a - place).norm() < (b - place).norm(); });
  return VertexIndex(found - surface.points.begin());
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

// Promise: a fin that spans a notch in a rim goes, though what is left of it would lie upon other triangles unless one
// edge is flipped, or two.
TEST(BareFolds, OpensNotches)
{
  TriangleMesh cube = makeCube(10);
  const VertexIndex notch = indexAt(cube, { 0., -0.5, 0.5 });
  const VertexIndex right = indexAt(cube, { 0.1, -0.5, 0.5 });
  const std::array<VertexIndex, 2> behind{ indexAt(cube, { 0.1, -0.4, 0.5 }),
    indexAt(cube, { 0., -0.4, 0.5 }) };
  cube.points[notch].y() += 0.05;
  const PointCloud cloud(pointsOn(cube));
  Mesh open = buildMesh(cube, cloud);
  for (const unsigned flips : { 2, 1 })
  {
    for (const Eigen::Vector3d& place :
      { Eigen::Vector3d(0., -0.52, 0.48), Eigen::Vector3d(0.05, -0.54, 0.45) })
    {
      Mesh mesh = open;
      for (unsigned i = 2 - flips; i < 2; ++i)
      {
        mesh.flip(notch, behind[i]);
      }
      const Ring& ring = mesh.ring(notch);
      const VertexIndex fin =
        mesh.split(notch, ring.before(ring.find(right)), 2, cloud.fromInput(place));
      EXPECT_EQ(collapsedOf(mesh, cloud), std::vector<VertexIndex>{ fin }) << place.transpose();
      EXPECT_NEAR(areaOf(mesh), areaOf(open), 1e-6) << place.transpose();
    }
    open.flip(notch, behind[0]);
  }
}
}
