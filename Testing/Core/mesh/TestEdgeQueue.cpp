// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "mesh/EdgeQueue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace neuralmesh::testing
{
// Costs are few, so that most are equal; what is pushed later may be cheaper than all that were taken.
TEST(EdgeQueue, GivesTheCheapestFirst)
{
  constexpr int Edges = 20000;
  constexpr std::uint32_t Costs = 50, Vertices = 1000;
  Random random(1);
  EdgeQueue<float> queue;
  std::multiset<WaitingEdge<float>> all;
  const auto push = [&]
  {
    const WaitingEdge<float> edge{ float(random.below(Costs)), VertexIndex(random.below(Vertices)),
      VertexIndex(random.below(Vertices)) };
    queue.push(edge);
    all.insert(edge);
  };
  for (int i = 0; i < Edges; ++i)
  {
    push();
  }
  for (int i = 0; !all.empty(); ++i)
  {
    ASSERT_FALSE(queue.empty());
    const WaitingEdge<float> edge = queue.takeCheapest();
    EXPECT_EQ(edge.cost, all.begin()->cost);
    EXPECT_EQ(edge.a, all.begin()->a);
    EXPECT_EQ(edge.b, all.begin()->b);
    all.erase(all.begin());
    if (i % 2 == 0 && i < Edges)
    {
      push();
    }
  }
  EXPECT_TRUE(queue.empty());
}
}
