// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Smoothing.h"

#include "MeshTools.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// An inner vertex moves by the tangential part of the mean of its edges, (6.2) to (6.4).
TEST(Smoothing, InnerVertexByFormula)
{
  Random random(1);
  const Mesh mesh = makeRandomMesh(200, random);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const Eigen::Vector3d center = mesh.position(v).toDouble();
    const Ring& ring = mesh.ring(v);
    Eigen::Vector3d laplacian = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
    for (unsigned slot = 0; slot < ring.size(); ++slot)
    {
      const Eigen::Vector3d edge = mesh.position(ring[slot]).toDouble() - center;
      laplacian += edge / ring.size();
      normal += edge.cross(mesh.position(ring[ring.after(slot)]).toDouble() - center);
    }
    normal.normalize();
    const Eigen::Vector3d tangential = laplacian - laplacian.dot(normal) * normal;
    const Eigen::Vector3d moved = smoothedPosition(mesh, v, 0.2f).toDouble();
    EXPECT_LT((moved - (center + 0.2 * tangential)).norm(), 1e-5);
  }
}

// A boundary vertex moves along the boundary only: openings do not close.
TEST(Smoothing, BoundaryVertexStaysOnTheBoundary)
{
  Mesh mesh = makeFan(6);
  const VertexIndex v = mesh.ring(0)[0];
  const Eigen::Vector3d front = mesh.position(mesh.ring(v).front()).toDouble();
  const Eigen::Vector3d back = mesh.position(mesh.ring(v).back()).toDouble();
  // In the middle between its neighbours it stays where it is.
  const Eigen::Vector3d before = mesh.position(v).toDouble();
  EXPECT_LT((smoothedPosition(mesh, v, 0.5f).toDouble() - before).norm(), 1e-6);
  // Off the middle it moves back along the chord of its neighbours.
  const Eigen::Vector3d along = (back - front).normalized();
  mesh.setPosition(v, Vector4(Eigen::Vector3d(before + 0.2 * along)));
  const Eigen::Vector3d moved = smoothedPosition(mesh, v, 0.5f).toDouble();
  EXPECT_LT((moved - (before + 0.1 * along)).norm(), 1e-6);
}

// Where all neighbours are on one spot, nothing moves to a place that is no number.
TEST(Smoothing, DegenerateStarStaysFinite)
{
  Mesh mesh = makeFan(5);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    mesh.setPosition(v, Vector4(0.5f, 0.5f, 0.5f));
  }
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_EQ(squaredNorm(smoothedPosition(mesh, v, 0.2f) - mesh.position(v)), 0.f);
  }
}
}
