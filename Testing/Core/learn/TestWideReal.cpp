// SPDX-License-Identifier: BSD-3-Clause
#include "learn/WideReal.h"

#include <gtest/gtest.h>

#include <vector>

namespace neuralmesh::testing
{
// Numbers are ordered by what they stand for, however far apart their epochs are.
TEST(WideReal, OrderAcrossEpochs)
{
  const std::vector<WideReal> rising{ { 0., 0 }, { 0x1p-250, 0 }, { 1., 0 }, { 0x1p250, 0 },
    { 0x1p-250, 1 }, { 0x1.8p-250, 1 }, { 1., 1 }, { 0x1p-250, 2 }, { 1., 2 }, { 0x1p250, 2 },
    { 0x1p-250, 7 }, { 0x1p250, 7 }, { 0x1p-250, 1000000 }, { 1., 1000000 }, { 1., 2000000000 } };
  for (std::size_t i = 0; i < rising.size(); ++i)
  {
    for (std::size_t j = 0; j < rising.size(); ++j)
    {
      EXPECT_EQ(rising[i] <=> rising[j], i <=> j) << i << " and " << j;
      EXPECT_EQ(rising[i] == rising[j], i == j) << i << " and " << j;
    }
  }
}

// One number has many forms; they are equal.
TEST(WideReal, EqualInTwoEpochs)
{
  EXPECT_EQ((WideReal{ 0x1p200, 3 }), (WideReal{ 0x1p-312, 4 }));
  EXPECT_LT((WideReal{ 0x1p200, 3 }), (WideReal{ 0x1.0000000000001p-312, 4 }));
  EXPECT_GT((WideReal{ 0x1.0000000000001p200, 3 }), (WideReal{ 0x1p-312, 4 }));
}

// A number in another epoch is scaled by powers of two, to zero or infinity out of range.
TEST(WideReal, InOtherEpoch)
{
  const WideReal number{ 0x1.5p10, 5 };
  EXPECT_EQ(number.in(5), 0x1.5p10);
  EXPECT_EQ(number.in(4), 0x1.5p522);
  EXPECT_EQ(number.in(6), 0x1.5p-502);
  EXPECT_EQ(number.in(8), 0.);
  EXPECT_EQ(number.in(2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(number.in(2000000000), 0.);
}

// Sums are right where the epochs differ by one, and keep the larger where they differ by more.
TEST(WideReal, SumsAcrossEpochs)
{
  const WideReal close = WideReal{ 0x1p256, 0 }.plus({ 0x1p-256, 1 });
  EXPECT_EQ(close, (WideReal{ 0x1p-255, 1 }));
  const WideReal small = WideReal{ 0x1p230, 0 }.plus({ 0x1p-256, 1 });
  EXPECT_EQ(small, (WideReal{ 0x1.0000004p-256, 1 }));
  const WideReal far = WideReal{ 1., 0 }.plus({ 0x1p-256, 3 });
  EXPECT_EQ(far, (WideReal{ 0x1p-256, 3 }));
  EXPECT_EQ(WideReal().plus({ 3., 2 }), (WideReal{ 3., 2 }));
  EXPECT_EQ((WideReal{ 3., 2 }.plus({ 4., 2 })), (WideReal{ 7., 2 }));
}

// A series that grows without end stays in order, and carrying changes no number.
TEST(WideReal, CarryKeepsNumbers)
{
  WideReal growing{ 1., 0 };
  std::vector<WideReal> terms;
  for (int i = 0; i < 40000; ++i)
  {
    WideReal carried = growing.times(1.25);
    const WideReal uncarried = carried;
    carried.carry();
    ASSERT_EQ(carried, uncarried);
    ASSERT_GT(carried, growing);
    ASSERT_LT(carried.significand, 0x1p256);
    growing = carried;
    terms.push_back(growing);
  }
  // 1.25 ^ 40000 is about 2 ^ 12877.
  EXPECT_EQ(growing.epoch, 25);
  for (std::size_t i = 0; i + 1000 < terms.size(); i += 997)
  {
    EXPECT_LT(terms[i], terms[i + 1000]);
    EXPECT_GT(terms[i + 1000], terms[i]);
    EXPECT_GT(terms[i].significand, 0.);
  }
}
}
