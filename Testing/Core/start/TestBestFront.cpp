// SPDX-License-Identifier: BSD-3-Clause
#include "start/BestFront.h"

#include "cloud/CloudGenerator.h"
#include "mesh/BoundaryManager.h"
#include "mesh/Pieces.h"

#include "ThinPlate.h"
#include "Wedge.h"

#include <gtest/gtest.h>

#include <set>

namespace neuralmesh::testing
{
// Keeps the promise: a start takes longer only where the evidence asks for more. Of a plate so thin that its
// layers grow together if they are not kept apart, a front that keeps them apart is closed and without narrow
// handles: no other samples are asked.
TEST(BestFront, OthersAreAskedOnlyInDoubt)
{
  constexpr std::size_t Count = 15000;
  CloudOptions options;
  options.count = 40000;
  const PointCloud cloud(generateCloud(makePlate(16, 0.0185), options));
  const NearestPoints nearest(cloud.points());
  PointLayers layers(nearest, Count);
  const auto joined = frontSurface(cloud, layers, Layers::Joined, 1, [](double) { return true; });
  ASSERT_TRUE(joined.has_value());
  EXPECT_GT(genusOf(joined->mesh), 0);

  std::set<double> told;
  const auto best = bestFront(
    cloud, nearest, Count, [&](double part) { return told.insert(part), true; }, LeastPiece, false);
  ASSERT_TRUE(best.has_value());
  EXPECT_TRUE(isCertain(*best));
  EXPECT_EQ(genusOf(best->mesh), 0);
  EXPECT_EQ(BoundaryManager(best->mesh).loopCount(), 0u);
  // That of the first two.
  EXPECT_LE(*told.rbegin(), 0.75);
}

// Keeps the promise: a wedge has no handles beside its edge, where one layer of samples lies between its two sides.
TEST(BestFront, EdgesOfWedgesHaveNoHandles)
{
  constexpr std::size_t Count = 11250;
  for (const double angle : { 10., 14. })
  {
    CloudOptions options;
    options.count = 100000;
    const TriangleMesh wedge = makeWedge(angle);
    const PointCloud cloud(generateCloud(wedge, options));
    const NearestPoints nearest(cloud.points());
    PointLayers layers(nearest, Count);
    const auto joined = frontSurface(cloud, layers, Layers::Joined, 1, [](double) { return true; });
    ASSERT_TRUE(joined.has_value());
    EXPECT_GT(genusOf(joined->mesh), 0) << angle;

    const auto best = bestFront(
      cloud, nearest, Count, [](double) { return true; }, LeastPiece, false);
    ASSERT_TRUE(best.has_value());
    EXPECT_EQ(genusOf(best->mesh), 0) << angle;
    EXPECT_LE(BoundaryManager(best->mesh).loopCount(), 2u) << angle;
    EXPECT_GT(areaOf(best->mesh), areaOf(joined->mesh)) << angle;
  }
}
}
