// SPDX-License-Identifier: BSD-3-Clause
#include "base/Progress.h"

#include "base/ProgressThrottle.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
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

// What was told is not taken back, not even by a copy; and whether to go on is passed back.
TEST(Progress, DoesNotFall)
{
  std::vector<double> told;
  const Progress whole = [&](double fraction)
  {
    told.push_back(fraction);
    return fraction < 0.7;
  };
  const Progress upwards = rising(whole);
  const Progress copy = upwards;
  EXPECT_TRUE(upwards(0.5));
  EXPECT_TRUE(copy(0.3));
  EXPECT_FALSE(copy(0.8));
  EXPECT_FALSE(upwards(0.1));
  EXPECT_EQ(told, (std::vector<double>{ 0.5, 0.5, 0.8, 0.8 }));
}

// Steps of a hundredth are passed on, and what comes later than the last one by 50 ms; of many reports at once
// hardly any.
TEST(ProgressThrottle, PassesOnWhatIsDue)
{
  ProgressThrottle throttle;
  for (const double fraction : { 0.01, 0.5, 0.9, 0.9101 })
  {
    EXPECT_TRUE(throttle.isDue(fraction));
  }
  int passed = 0;
  for (int i = 0; i < 10000; ++i)
  {
    passed += throttle.isDue(0.915) ? 1 : 0;
  }
  EXPECT_LT(passed, 10000);
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_TRUE(throttle.isDue(0.915));
}
}
