// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/EdgeValues.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// Promise: an edge finds its value from either end, and no other edge's.
TEST(TestEdgeValues, EachEdgeHasItsOwn)
{
  constexpr VertexIndex Count = 100;
  EdgeValues<unsigned> values(Count * Count / 2);
  for (VertexIndex a = 0; a < Count; ++a)
  {
    for (VertexIndex b = a + 1; b < Count; ++b)
    {
      EXPECT_EQ(values.at(a, b), 0u);
      values.at(a, b) = a * Count + b;
    }
  }
  for (VertexIndex a = 0; a < Count; ++a)
  {
    for (VertexIndex b = a + 1; b < Count; ++b)
    {
      EXPECT_EQ(values.at(b, a), a * Count + b);
    }
  }
}

// Promise: more edges than expected are kept just as well.
TEST(TestEdgeValues, MoreThanExpected)
{
  constexpr VertexIndex Count = 1000;
  EdgeValues<VertexIndex> values(0);
  for (VertexIndex v = 0; v < Count; ++v)
  {
    values.at(v, v + 1) = v;
  }
  for (VertexIndex v = 0; v < Count; ++v)
  {
    EXPECT_EQ(values.at(v + 1, v), v);
  }
}
}
