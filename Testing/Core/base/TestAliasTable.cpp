// SPDX-License-Identifier: BSD-3-Clause
#include "base/AliasTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace neuralmesh::testing
{
// Every index is drawn in proportion to its weight, those of weight 0 never.
TEST(AliasTable, InProportion)
{
  constexpr int Draws = 400000;
  for (const std::vector<float>& weights :
    { std::vector<float>{ 1.f, 2.f, 0.f, 4.f, 1.f }, std::vector<float>{ 0.f, 0.f, 1e-20f },
      std::vector<float>{ 1e30f, 3e30f, 1e-30f }, std::vector<float>(100, 0.1f) })
  {
    double sum = 0.;
    for (const float weight : weights)
    {
      sum += double(weight);
    }
    const AliasTable table(weights);
    Random random(4);
    std::vector<int> counts(weights.size());
    for (int i = 0; i < Draws; ++i)
    {
      ++counts.at(table.draw(random));
    }
    for (std::size_t i = 0; i < weights.size(); ++i)
    {
      const double share = double(weights[i]) / sum;
      EXPECT_NEAR(double(counts[i]) / Draws, share, 6. * std::sqrt(share / Draws)) << "index " << i;
    }
  }
}

// A table without weights is empty.
TEST(AliasTable, Empty)
{
  EXPECT_TRUE(AliasTable({}).isEmpty());
  EXPECT_FALSE(AliasTable(std::vector<float>{ 1.f }).isEmpty());
}
}
