// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ListOrder.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// Vertices 0 ... 8, of which 0 is the laziest.
ListOrder nine(double jumpFraction)
{
  return { std::vector<VertexIndex>{ 0, 1, 2, 3, 4, 5, 6, 7, 8 }, jumpFraction, 1 };
}

/// Takes the order apart, from the laziest to the most active.
std::vector<VertexIndex> laziestFirst(ListOrder order, std::size_t count)
{
  std::vector<VertexIndex> result;
  while (result.size() < count)
  {
    result.push_back(order.bottom());
    order.erase(result.back());
  }
  return result;
}
}

// A winner jumps by the fraction of n, times its gain; passing does nothing.
TEST(ListOrder, WinnersJump)
{
  ListOrder order = nine(1. / 3.);
  order.win(1, 1., 0.95);
  EXPECT_EQ(laziestFirst(order, 9), (std::vector<VertexIndex>{ 0, 2, 3, 4, 1, 5, 6, 7, 8 }));
  order.win(0, 2., 0.95);
  EXPECT_EQ(laziestFirst(order, 9), (std::vector<VertexIndex>{ 2, 3, 4, 1, 5, 6, 0, 7, 8 }));
  order.win(7, 1., 0.95);
  EXPECT_EQ(order.top(), 7u);
  order.pass(0.5);
  EXPECT_EQ(order.top(), 7u);
  EXPECT_EQ(order.bottom(), 2u);
  ListOrder slow = nine(1. / 9.);
  slow.win(4, 1., 0.95);
  EXPECT_EQ(laziestFirst(slow, 9), (std::vector<VertexIndex>{ 0, 1, 2, 3, 5, 4, 6, 7, 8 }));
}

// After a split both vertices are where their shares put them.
TEST(ListOrder, SplitSharesThePlace)
{
  ListOrder order = nine(1. / 3.);
  order.split(8, 9, 0.75);
  EXPECT_EQ(laziestFirst(order, 10), (std::vector<VertexIndex>{ 0, 1, 9, 2, 3, 4, 5, 8, 6, 7 }));
}

// What cannot be split leaves the top, what cannot be removed leaves the bottom, for others.
TEST(ListOrder, IllegalOnesGiveWay)
{
  ListOrder order = nine(1. / 3.);
  order.demoteTop();
  EXPECT_EQ(laziestFirst(order, 9), (std::vector<VertexIndex>{ 0, 1, 2, 3, 8, 4, 5, 6, 7 }));
  order.promoteBottom();
  EXPECT_EQ(laziestFirst(order, 9), (std::vector<VertexIndex>{ 1, 2, 3, 0, 8, 4, 5, 6, 7 }));
  ListOrder still = nine(0.);
  still.promoteBottom();
  EXPECT_EQ(still.bottom(), 1u);
}

// Activity is the place in the list, 1 at the top.
TEST(ListOrder, ActivityIsThePlace)
{
  const ListOrder order = nine(1. / 3.);
  EXPECT_DOUBLE_EQ(order.activity(8), 1.);
  EXPECT_DOUBLE_EQ(order.activity(0), 1. / 9.);
}

// The lots say yes as often as is expected, and the same way for the same seed.
TEST(ListOrder, LotsGiveTheExpectedCount)
{
  for (const double expected : { 0., 0.028, 0.5, 3. })
  {
    ListOrder order = nine(1. / 3.), same = nine(1. / 3.);
    constexpr int Removals = 1'000'000;
    int yes = 0;
    for (int i = 0; i < Removals; ++i)
    {
      for (bool isBelow = true; isBelow; yes += isBelow)
      {
        isBelow = order.isBottomBelow(0.5, expected);
        ASSERT_EQ(same.isBottomBelow(0.5, expected), isBelow);
      }
    }
    EXPECT_NEAR(double(yes) / Removals, expected, 0.02 * expected);
  }
}
}
