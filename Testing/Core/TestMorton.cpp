// SPDX-License-Identifier: BSD-3-Clause
#include "Morton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace neuralmesh::testing
{
// However small or large the box, all points are in the order, once; those along its diagonal one
// after the other.
TEST(Morton, AnyExtent)
{
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  for (const float size : { 0.f, smallest, 1e-40f, 1e-30f, 1.f, 1e30f })
  {
    std::vector<Vector4> points;
    for (int i = 0; i <= 16; ++i)
    {
      const float place = size * float(i) / 16.f;
      points.emplace_back(place, place, place);
    }
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(mortonOrder(points, points.front(), points.back()), expected) << size;
  }
}
}
