// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LeastCut.h"

#include "base/Random.h"
#include "OpenShapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
constexpr unsigned QuadsAlong = 40;

/// A sheet that is narrow where `waist` is, 0 to 1 along x.
TriangleMesh hourglass(double waist)
{
  TriangleMesh mesh = makeGrid(QuadsAlong);
  std::erase_if(mesh.triangles,
    [&](const auto& triangle)
    {
      const Eigen::Vector3d center =
        (mesh.points[triangle[0]] + mesh.points[triangle[1]] + mesh.points[triangle[2]]) / 3.;
      return std::abs(center.y() - 0.5) > std::abs(center.x() - waist) + 0.1;
    });
  return mesh;
}

double along(const TriangleMesh& mesh, std::uint32_t triangle)
{
  const auto& [a, b, c] = mesh.triangles[triangle];
  return (mesh.points[a].x() + mesh.points[b].x() + mesh.points[c].x()) / 3.;
}

std::vector<std::int8_t> knownAtEnds(const TriangleMesh& mesh)
{
  std::vector<std::int8_t> known(mesh.triangles.size(), 0);
  for (std::uint32_t t = 0; t < known.size(); ++t)
  {
    const double x = along(mesh, t);
    known[t] = std::int8_t(x < 0.05 ? 1 : x > 0.95 ? -1 : 0);
  }
  return known;
}

std::vector<std::int8_t> divided(const TriangleMesh& mesh, std::vector<std::int8_t> sides)
{
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  divideByLeastCut(mesh, neighborsIn(mesh), all, sides);
  return sides;
}
}

// Between two ends of a sheet that are known the cut is where the sheet is narrow, wherever that is.
TEST(LeastCut, IsWhereASheetIsNarrow)
{
  for (const double waist : { 0.25, 0.5, 0.8 })
  {
    const TriangleMesh mesh = hourglass(waist);
    const std::vector<std::int8_t> sides = divided(mesh, knownAtEnds(mesh));
    for (std::uint32_t t = 0; t < sides.size(); ++t)
    {
      const double x = along(mesh, t);
      if (std::abs(x - waist) > 0.06)
      {
        ASSERT_EQ(int(sides[t]), x < waist ? 1 : -1) << waist << " " << x;
      }
    }
  }
}

// What is known stays, though the cut would be shorter without it, and where one side alone is known all is of it.
TEST(LeastCut, KeepsWhatIsKnown)
{
  const TriangleMesh mesh = makeGrid(QuadsAlong);
  std::vector<std::int8_t> known(mesh.triangles.size(), 1);
  known[QuadsAlong * QuadsAlong] = -1;
  EXPECT_EQ(divided(mesh, known), known);
  for (const std::int8_t side : { std::int8_t(1), std::int8_t(-1) })
  {
    std::vector<std::int8_t> one(mesh.triangles.size(), 0);
    one[QuadsAlong] = side;
    EXPECT_EQ(divided(mesh, one), std::vector<std::int8_t>(mesh.triangles.size(), side));
  }
}

// A large sheet that is as wide everywhere has so many short cuts that the search for the shortest is given up: each
// triangle gets the side of those that are nearest.
TEST(LeastCut, IsHalfwayWhereTheSearchTakesTooLong)
{
  constexpr unsigned LargeSide = 300;
  TriangleMesh mesh = makeGrid(LargeSide);
  Random random(1);
  for (Eigen::Vector3d& point : mesh.points)
  {
    point.x() += 0.3 * (random.uniform() - 0.5) / LargeSide;
    point.y() += 0.3 * (random.uniform() - 0.5) / LargeSide;
  }
  const std::vector<std::int8_t> sides = divided(mesh, knownAtEnds(mesh));
  for (std::uint32_t t = 0; t < sides.size(); ++t)
  {
    const double x = along(mesh, t);
    if (std::abs(x - 0.5) > 0.02)
    {
      ASSERT_EQ(int(sides[t]), x < 0.5 ? 1 : -1) << x;
    }
  }
}
}
