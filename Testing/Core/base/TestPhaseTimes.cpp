// SPDX-License-Identifier: BSD-3-Clause
#include "base/PhaseTimes.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
namespace
{
void work(double seconds)
{
  const std::clock_t begin = std::clock();
  while (double(std::clock() - begin) / CLOCKS_PER_SEC < seconds)
  {
  }
}
}

// What is done in a phase counts there and nowhere else, each time it is entered; outside of all it
// does not count.
TEST(PhaseTimes, CountWhereTheyBelong)
{
  PhaseTimes times;
  work(0.02);
  times.enter(Phase::Start);
  work(0.02);
  times.enter(Phase::Learning);
  times.enter(Phase::Start);
  work(0.02);
  times.leave();
  work(0.05);
  times.leave();
  EXPECT_GE(times.seconds(Phase::Start), 0.04);
  EXPECT_LT(times.seconds(Phase::Start), 0.08);
  EXPECT_LT(times.seconds(Phase::Learning), 0.01);
  EXPECT_EQ(times.seconds(Phase::Finish), 0.);
  PhaseTimes sum = times;
  sum.add(times);
  EXPECT_EQ(sum.seconds(Phase::Start), 2. * times.seconds(Phase::Start));
}
}
