// SPDX-License-Identifier: BSD-3-Clause
#include "base/MovingStatistics.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace neuralmesh::testing
{
// Mean and deviation are those of the last observations, and stay so for ever.
TEST(MovingStatistics, LastObservationsOnly)
{
  constexpr std::size_t Window = 100;
  MovingStatistics statistics(Window);
  EXPECT_EQ(statistics.mean(), 0.);
  EXPECT_EQ(statistics.deviation(), 0.);
  Random random(1);
  std::vector<double> all;
  for (std::size_t i = 0; i < 5000; ++i)
  {
    // Large numbers first: their rounding errors must not stay behind.
    all.push_back((i < 1000 ? 1e6 : 1.) * random.uniform());
    statistics.add(all.back());
    EXPECT_EQ(statistics.count(), std::min(i + 1, Window));
    EXPECT_EQ(statistics.isFull(), i + 1 >= Window);
    if (i < 1000 || i > 1200)
    {
      const std::size_t count = statistics.count();
      double mean = 0., variance = 0.;
      for (std::size_t k = all.size() - count; k < all.size(); ++k)
      {
        mean += all[k] / double(count);
      }
      for (std::size_t k = all.size() - count; k < all.size(); ++k)
      {
        variance += (all[k] - mean) * (all[k] - mean) / double(count);
      }
      EXPECT_NEAR(statistics.mean(), mean, 1e-9 * std::max(1., mean));
      EXPECT_NEAR(statistics.deviation(), std::sqrt(variance), 1e-6 * std::max(1., mean));
    }
  }
}
}
