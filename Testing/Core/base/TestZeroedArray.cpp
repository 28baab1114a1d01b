// SPDX-License-Identifier: BSD-3-Clause
#include "base/ZeroedArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace neuralmesh
{
// Promise: all values are 0, of small arrays and of large ones, although memory has been used before; copies have the
// values of what is copied.
TEST(ZeroedArray, IsZero)
{
  const auto isZero = [](float value) { return value == 0.f; };
  for (int round = 0; round < 3; ++round)
  {
    for (const std::size_t count : { std::size_t(1), std::size_t(1000), std::size_t(3) << 20 })
    {
      ZeroedArray<float> values(count);
      EXPECT_EQ(values.size(), count);
      EXPECT_TRUE(std::all_of(values.begin(), values.end(), isZero)) << count;
      std::fill(values.begin(), values.end(), 7.f);
      const ZeroedArray<float> copy = values;
      values[0] = 3.f;
      EXPECT_EQ(copy[0], 7.f);
      EXPECT_EQ(copy[count - 1], 7.f);
      const ZeroedArray<float> moved = std::move(values);
      EXPECT_EQ(moved[0], 3.f);
      EXPECT_EQ(moved.size(), count);
    }
  }
  EXPECT_EQ(ZeroedArray<float>().size(), 0u);
}
}
