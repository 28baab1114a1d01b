// SPDX-License-Identifier: BSD-3-Clause
#include "base/EvenSort.h"
#include "base/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh::testing
{
// Keeps the promise: values are sorted, though they are spread unevenly, all the same, or beyond the ends.
TEST(EvenSort, AsSortingHasIt)
{
  Random random(5);
  for (const std::size_t count : { 1u, 2u, 24u, 96u, 500u })
  {
    for (const double unevenness : { 1., 3., 30. })
    {
      for (const double scale : { 1., 0., 50., std::numeric_limits<double>::infinity() })
      {
        std::vector<double> values(count), sorted(count);
        for (double& value : values)
        {
          value = std::pow(random.uniform(), unevenness);
        }
        values.front() = 0.;
        sortEven<double>(values, sorted, [=](double value) { return scale * value; });
        std::sort(values.begin(), values.end());
        EXPECT_EQ(sorted, values);
      }
    }
  }
}
}
