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
/// What there is beside a web whose upper side reaches from 4 to 12, and whose lower side from 9 to 17 along the sheets.
enum class Behind
{
  Nothing,
  Surface, ///< behind all of both sides
  Another  ///< an empty piece behind the rest of the upper side
};

std::size_t websBeside(Behind rest, bool isUpperGap)
{
  TriangleMesh sheets = joinedSheets({});
  const auto isUpper = [](const Eigen::Vector3d& place) { return place.z() > 0.5; };
  if (rest != Behind::Surface)
  {
    const double leastBelow = rest == Behind::Another ? 4. : 9.;
    std::erase_if(sheets.triangles,
      [&](const auto& triangle)
      {
        const auto& [a, b, c] = triangle;
        const Eigen::Vector3d place = (sheets.points[a] + sheets.points[b] + sheets.points[c]) / 3.;
        return isUpper(place) ? place.x() > 12. : place.x() < leastBelow;
      });
  }
  const Mesh mesh = meshOf(sheets);
  const NumberedTriangles triangles(mesh, Executor::sequential());
  std::vector<EmptyPiece> pieces(3);
  for (std::uint32_t t = 0; t < triangles.all().size(); ++t)
  {
    const Eigen::Vector3d place = cleanSphere().toInput(centerOf(mesh, triangles.all()[t]));
    const auto isIn = [&](double least, double most)
    { return place.y() > 8. && place.y() < 16. && place.x() > least && place.x() < most; };
    const std::size_t piece = isUpper(place)    ? (isIn(4., 12.) ? 0 : 3)
      : isIn(9., 17.)                           ? 1
      : isIn(4., 9.) && rest == Behind::Another ? 2
                                                : 3;
    if (piece < pieces.size())
    {
      pieces[piece].triangles.push_back(t);
      pieces[piece].area += areaOf(mesh, triangles.all()[t]);
    }
  }
  return findWebs(mesh, triangles.all(), pieces, { true, true, true }, { isUpperGap, false, false })
    .size();
}
}

TEST(Webs, SidesOfWhichAPartLiesBehindTheOther)
{
  EXPECT_EQ(websBeside(Behind::Nothing, false), 2u);
  EXPECT_EQ(websBeside(Behind::Surface, false), 0u);
  EXPECT_EQ(websBeside(Behind::Surface, true), 0u);
}

// The lower side is one of a web, too, if the upper one is a gap already.
TEST(Webs, SideOfAGap)
{
  EXPECT_EQ(websBeside(Behind::Another, false), 2u);
  EXPECT_EQ(websBeside(Behind::Another, true), 3u);
}
}
