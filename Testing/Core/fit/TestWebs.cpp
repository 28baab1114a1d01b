// SPDX-License-Identifier: BSD-3-Clause
// Promise: two empty parts of a surface, back to back, are the sides of a web, also where a part of a side has nothing
// behind it.
#include "fit/Webs.h"

#include "JoinedSheets.h"
#include "mesh/NumberedTriangles.h"
#include "mesh/Pieces.h"
#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// A web whose upper side reaches from 4 to 12, and whose lower side from 9 to 17 along the sheets. With `rest`, there is
/// surface behind all of both.
std::size_t websOf(bool rest, bool isUpperGap)
{
  TriangleMesh sheets = joinedSheets({});
  const auto placeOf = [&](const auto& triangle)
  {
    return Eigen::Vector3d(
      (sheets.points[triangle[0]] + sheets.points[triangle[1]] + sheets.points[triangle[2]]) / 3.);
  };
  const auto isUpper = [](const Eigen::Vector3d& place) { return place.z() > 0.5; };
  if (!rest)
  {
    std::erase_if(sheets.triangles,
      [&](const auto& triangle)
      {
        const Eigen::Vector3d place = placeOf(triangle);
        return isUpper(place) ? place.x() > 12. : place.x() < 9.;
      });
  }
  const Mesh mesh = meshOf(sheets);
  const NumberedTriangles triangles(mesh, Executor::sequential());
  std::vector<EmptyPiece> pieces(2);
  for (std::uint32_t t = 0; t < triangles.all().size(); ++t)
  {
    const Eigen::Vector3d place = cleanSphere().toInput(centerOf(mesh, triangles.all()[t]));
    const bool up = isUpper(place);
    if (place.y() > 8. && place.y() < 16. && place.x() > (up ? 4. : 9.) &&
      place.x() < (up ? 12. : 17.))
    {
      EmptyPiece& piece = pieces[up ? 0 : 1];
      piece.triangles.push_back(t);
      piece.area += areaOf(mesh, triangles.all()[t]);
    }
  }
  return findWebs(mesh, triangles.all(), pieces, { true, true }, { isUpperGap, false }).size();
}
}

TEST(Webs, SidesOfWhichAPartLiesBehindTheOther)
{
  EXPECT_EQ(websOf(false, false), 2u);
  EXPECT_EQ(websOf(true, false), 0u);
  EXPECT_EQ(websOf(true, true), 0u);
}
}
