// SPDX-License-Identifier: BSD-3-Clause
#include "base/Median.h"
#include "base/Random.h"
#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace neuralmesh::testing
{
// Half of the others are less at most, and half are more: as sorting has it, on any number of threads.
TEST(Median, AsSortingHasIt)
{
  Random random(3);
  const ThreadPool three(3);
  for (const std::size_t count : { 1u, 2u, 3u, 10u, 1001u, 100000u })
  {
    for (const double spread : { 0., 1., 60. })
    {
      std::vector<float> values(count);
      for (float& value : values)
      {
        value = float(std::exp(spread * (random.uniform() - 0.5)));
      }
      values.front() = 0.f;
      values.back() = count > 2 ? std::numeric_limits<float>::infinity() : values.back();
      std::vector<float> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(medianOf(values), sorted[count / 2]);
      EXPECT_EQ(medianOf(values, Executor::sequential()), sorted[count / 2]);
      EXPECT_EQ(medianOf(values, three), sorted[count / 2]);
    }
  }
}
}
