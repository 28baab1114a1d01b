// SPDX-License-Identifier: BSD-3-Clause
#include "base/BucketOrder.h"
#include "base/Random.h"

#include <gtest/gtest.h>

namespace neuralmesh::testing
{
// Each bucket has the items that fall into it, in their order; those that are passed over are nowhere.
TEST(BucketOrder, HasEachItemInItsBucket)
{
  constexpr std::size_t Count = 1000, Buckets = 7;
  Random random(1);
  std::vector<std::size_t> bucketOf;
  for (std::size_t i = 0; i < Count; ++i)
  {
    bucketOf.push_back(random.below(Buckets + 1)); // the last one is none
  }
  for (const std::size_t grain : { std::size_t(1), std::size_t(64), Count, 2 * Count })
  {
    const auto forEach = [&](std::size_t begin, std::size_t end, const auto& use)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        if (bucketOf[i] < Buckets)
        {
          use(i, bucketOf[i]);
        }
      }
    };
    const BucketOrder order(Count, grain, Buckets, forEach, Executor::sequential());
    ASSERT_EQ(order.bucketCount(), Buckets);
    std::size_t items = 0;
    for (std::size_t bucket = 0; bucket < Buckets; ++bucket)
    {
      std::vector<std::uint32_t> expected;
      for (std::size_t i = 0; i < Count; ++i)
      {
        if (bucketOf[i] == bucket)
        {
          expected.push_back(std::uint32_t(i));
        }
      }
      EXPECT_EQ(order.begin(bucket), items);
      const auto found = order.items(bucket);
      EXPECT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()), expected);
      items += expected.size();
    }
    EXPECT_EQ(order.itemCount(), items);
  }
}
}
