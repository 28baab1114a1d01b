// SPDX-License-Identifier: BSD-3-Clause
#include "base/Progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
// A part of a run reports its own fractions as those of the whole, parts of parts, too; and whether
// to go on is passed back.
TEST(Progress, PartsAreOfTheWhole)
{
  std::vector<double> told;
  const Progress whole = [&](double fraction)
  {
    told.push_back(fraction);
    return fraction < 0.7;
  };
  const Progress part = partOf(whole, 0.5, 0.9);
  const Progress partOfPart = partOf(part, 0., 0.5);
  EXPECT_TRUE(part(0.));
  EXPECT_TRUE(partOfPart(0.5));
  EXPECT_FALSE(part(1.));
  ASSERT_EQ(told.size(), 3u);
  EXPECT_DOUBLE_EQ(told[0], 0.5);
  EXPECT_DOUBLE_EQ(told[1], 0.6);
  EXPECT_DOUBLE_EQ(told[2], 0.9);
}
}
