// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// SplitMix64 as published by Vigna, in the words of its authors: a sum and two multiplications.
struct SplitMix64
{
  std::uint64_t x;
  std::uint64_t next()
  {
    std::uint64_t z = (this->x += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
};

/// Stream `stream` of a seed starts where both have been mixed.
SplitMix64 reference(std::uint64_t seed, std::uint64_t stream)
{
  SplitMix64 ofSeed{ seed };
  SplitMix64 ofStream{ (stream - 1) * 0x9e3779b97f4a7c15 + 1 };
  return { ofSeed.next() ^ ofStream.next() };
}
}

// The reference itself gives the published first numbers of seed 1234567.
TEST(Random, ReferenceIsSplitMix64)
{
  SplitMix64 generator{ 1234567 };
  EXPECT_EQ(generator.next(), 6457827717110365317u);
  EXPECT_EQ(generator.next(), 3203168211198807973u);
  EXPECT_EQ(generator.next(), 9817491932198370423u);
  EXPECT_EQ(generator.next(), 4593380528125082431u);
  EXPECT_EQ(generator.next(), 16408922859458223821u);
}

// Every seed and stream gives the same numbers, on every platform and for ever.
TEST(Random, KnownNumbers)
{
  for (const std::uint64_t seed : { 0ull, 1ull, 42ull, 0xffffffffffffffffull })
  {
    for (const std::uint64_t stream : { 0ull, 1ull, 7ull })
    {
      SplitMix64 expected = reference(seed, stream);
      Random random(seed, stream);
      for (int i = 0; i < 100; ++i)
      {
        ASSERT_EQ(random.next(), expected.next()) << seed << ", " << stream << ", " << i;
      }
    }
  }
  Random pinned(1);
  EXPECT_EQ(pinned.next(), 107434381087761299u);
  EXPECT_EQ(pinned.next(), 15700819504754284306u);
  EXPECT_EQ(pinned.next(), 3007578660745852719u);
}

// below() and uniform() stay in their ranges and fill them evenly.
TEST(Random, Uniform)
{
  constexpr int Draws = 200000;
  constexpr std::uint32_t Bins = 100;
  Random random(3);
  std::vector<int> integers(Bins), reals(Bins);
  for (int i = 0; i < Draws; ++i)
  {
    const std::uint32_t integer = random.below(Bins);
    const double real = random.uniform();
    ASSERT_LT(integer, Bins);
    ASSERT_GE(real, 0.);
    ASSERT_LT(real, 1.);
    ++integers[integer];
    ++reals[std::size_t(real * Bins)];
  }
  for (const auto& counts : { integers, reals })
  {
    double chiSquare = 0.;
    for (const int count : counts)
    {
      const double expected = double(Draws) / Bins;
      chiSquare += (count - expected) * (count - expected) / expected;
    }
    // 99 degrees of freedom: mean 99, standard deviation 14.
    EXPECT_LT(chiSquare, 99. + 6. * 14.);
    EXPECT_GT(chiSquare, 99. - 6. * 14.);
  }
  EXPECT_EQ(Random(9).below(1), 0u);
}

// Other seeds and other streams give other numbers.
TEST(Random, SeedsAndStreamsDiffer)
{
  std::set<std::uint64_t> first;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
  {
    for (std::uint64_t stream = 0; stream < 10; ++stream)
    {
      first.insert(Random(seed, stream).next());
    }
  }
  EXPECT_EQ(first.size(), 1000u);
}
}
