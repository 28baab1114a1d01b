// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/OppositeLayer.h"

#include "base/Random.h"
#include "cloud/MeshBuilder.h"
#include "SphereRuns.h"
#include "ThinPlate.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
namespace
{
/// The vertices of a mesh; that must outlive it.
ClosestVertex closestIn(const Mesh& mesh, VertexGrid grid)
{
  return [&mesh, grid = std::move(grid)](Vector4 point)
  { return grid.closest(point, mesh.positions()); };
}

constexpr unsigned QuadranglesOfPlate = 20;
constexpr double EdgeOfPlate = 1. / QuadranglesOfPlate;
}

// Behind each vertex of a plate thinner than edges are long, but for the rim, there is one of the other side,
// however thin it is; behind those of a thicker one, and of a sphere, there is none.
TEST(OppositeLayer, IsThereWhereAPartIsThin)
{
  for (const double edges : { 0.05, 0.3, 0.8, 2. })
  {
    SCOPED_TRACE(edges);
    const double thickness = edges * EdgeOfPlate;
    const PointCloud cloud(platePoints(5000, thickness));
    const Mesh mesh = buildMesh(makePlate(QuadranglesOfPlate, thickness), cloud);
    const std::vector<VertexIndex> opposite =
      oppositeVertices(mesh, closestIn(mesh, gridOf(mesh, cloud)), {});
    EXPECT_EQ(oppositeVertices(mesh, gridOf(mesh, cloud)), opposite);
    std::size_t found = 0;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (opposite[v] != NoVertex)
      {
        ++found;
        const Vector4 normal = mesh.normal(v), other = mesh.normal(opposite[v]);
        EXPECT_LT(dot(normal, other), 0.f);
      }
    }
    if (edges < 1.)
    {
      EXPECT_GT(found, 2u * (QuadranglesOfPlate - 1) * (QuadranglesOfPlate - 1) - 1u);
    }
    else
    {
      EXPECT_EQ(found, 0u);
    }
  }
  const Mesh sphere = meshOf(makeSphere(12));
  const std::vector<VertexIndex> none =
    oppositeVertices(sphere, closestIn(sphere, gridOf(sphere, cleanSphere())), {});
  EXPECT_TRUE(std::all_of(none.begin(), none.end(), [](VertexIndex v) { return v == NoVertex; }));
}

// Where vertices lie anywhere beside each other, turned to all sides, those for which none is looked for have none.
TEST(OppositeLayer, IsNotMissed)
{
  const PointCloud cloud(platePoints(5000, EdgeOfPlate));
  Mesh mesh = buildMesh(makePlate(QuadranglesOfPlate, EdgeOfPlate), cloud);
  Random random(1);
  for (Vector4& position : mesh.movablePositions())
  {
    const auto step = [&random] { return 0.1f * float(random.uniform() - 0.5); };
    position += Vector4(step(), step(), step());
  }
  const VertexGrid grid = gridOf(mesh, cloud);
  const std::vector<VertexIndex> opposite = oppositeVertices(mesh, closestIn(mesh, grid), {});
  const auto found =
    std::count_if(opposite.begin(), opposite.end(), [](VertexIndex v) { return v != NoVertex; });
  EXPECT_GT(found, std::ptrdiff_t(opposite.size() / 10));
  EXPECT_LT(found, std::ptrdiff_t(opposite.size() - opposite.size() / 10));
  EXPECT_EQ(oppositeVertices(mesh, grid), opposite);
}

// Only those that are asked for are looked at.
TEST(OppositeLayer, OfThoseThatAreAsked)
{
  const double thickness = 0.3 * EdgeOfPlate;
  const PointCloud cloud(platePoints(5000, thickness));
  const Mesh mesh = buildMesh(makePlate(QuadranglesOfPlate, thickness), cloud);
  const VertexGrid grid = gridOf(mesh, cloud);
  const std::vector<VertexIndex> all = oppositeVertices(mesh, closestIn(mesh, grid), {});
  std::vector<std::uint8_t> isAsked(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); v += 3)
  {
    isAsked[v] = 1;
  }
  const std::vector<VertexIndex> some = oppositeVertices(mesh, closestIn(mesh, grid), isAsked);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    EXPECT_EQ(some[v], isAsked[v] != 0 ? all[v] : NoVertex);
  }
}

// The place of a point is on the side of the plate on which it lies, whichever vertex is closest.
TEST(OppositeLayer, PlacesFaceTheirPoints)
{
  const double thickness = 0.3 * EdgeOfPlate;
  const std::vector<Eigen::Vector3d> points = platePoints(4000, thickness);
  const PointCloud cloud(points);
  TriangleMesh plate = makePlate(QuadranglesOfPlate, thickness);
  // Sides that do not mirror each other: the closest vertex is often one of the other side.
  for (std::size_t v = 0; v < plate.points.size() / 2; ++v)
  {
    Eigen::Vector3d& point = plate.points[v];
    const bool isInside = point.x() > 0. && point.x() < 1. && point.y() > 0. && point.y() < 1.;
    point += (isInside ? EdgeOfPlate : 0.) * Eigen::Vector3d(0.5, 0.5, 0.);
  }
  const Mesh mesh = buildMesh(plate, cloud);
  const VertexGrid grid = gridOf(mesh, cloud);
  const std::vector<VertexIndex> opposite = oppositeVertices(mesh, closestIn(mesh, grid), {});
  std::size_t asked = 0, onItsSide = 0, byClosest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double fromRim =
      std::min({ points[i].x(), points[i].y(), 1. - points[i].x(), 1. - points[i].y() });
    if (fromRim < 3. * EdgeOfPlate)
    {
      continue;
    }
    ++asked;
    const Vector4 point = cloud.fromInput(points[i]);
    const VertexIndex closest = grid.closest(point, mesh.positions());
    const auto isOnSide = [&](const PlaceOnMesh& place)
    { return (cloud.toInput(mesh.position(place.triangle[0])).z() > 0.) == (points[i].z() > 0.); };
    onItsSide += isOnSide(facingPlace(point, mesh, closest, opposite[closest])) ? 1 : 0;
    byClosest += isOnSide(closestPlaceAt(point, mesh, closest)) ? 1 : 0;
  }
  ASSERT_GT(asked, 1000u);
  EXPECT_EQ(onItsSide, asked);
  EXPECT_LT(byClosest, asked);
}
}
