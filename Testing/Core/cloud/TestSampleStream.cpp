// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/SampleStream.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// Points that tell their index.
std::vector<Vector4> numberedPoints(std::size_t count)
{
  std::vector<Vector4> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    points.emplace_back(float(i), -float(i), 0.5f);
  }
  return points;
}

std::vector<std::size_t> drawIndices(SampleStream& stream, std::size_t count)
{
  std::vector<std::size_t> indices;
  for (const Vector4 sample : stream.draw(count))
  {
    EXPECT_EQ(sample[1], -sample[0]);
    EXPECT_EQ(sample[2], 0.5f);
    indices.push_back(std::size_t(sample[0]));
  }
  return indices;
}
}

// A batch is the draws of the generator with the seed: what the samples are depends on it alone.
TEST(SampleStream, KnownSamples)
{
  const std::vector<Vector4> points = numberedPoints(1000);
  SampleStream stream(points, 42);
  Random random(42);
  for (const std::size_t count : { 1, 10, 1000, 37 })
  {
    std::vector<std::size_t> expected;
    for (std::size_t i = 0; i < count; ++i)
    {
      expected.push_back(random.below(1000));
    }
    std::vector<std::size_t> drawn = drawIndices(stream, count);
    std::sort(expected.begin(), expected.end());
    std::sort(drawn.begin(), drawn.end());
    EXPECT_EQ(drawn, expected);
  }
}

// The size of the batches does not change which samples are drawn.
TEST(SampleStream, BatchSizeDoesNotMatter)
{
  const std::vector<Vector4> points = numberedPoints(500);
  SampleStream single(points, 3), batched(points, 3);
  std::vector<std::size_t> oneByOne, atOnce = drawIndices(batched, 300);
  for (int i = 0; i < 300; ++i)
  {
    oneByOne.push_back(drawIndices(single, 1).front());
  }
  std::sort(oneByOne.begin(), oneByOne.end());
  std::sort(atOnce.begin(), atOnce.end());
  EXPECT_EQ(oneByOne, atOnce);
}

// Every point of the cloud is drawn as often as any other.
TEST(SampleStream, Uniform)
{
  constexpr std::size_t Points = 200;
  constexpr std::size_t Draws = 200000;
  const std::vector<Vector4> points = numberedPoints(Points);
  SampleStream stream(points, 5);
  std::vector<int> counts(Points);
  for (std::size_t drawn = 0; drawn < Draws; drawn += 1000)
  {
    for (const std::size_t index : drawIndices(stream, 1000))
    {
      ASSERT_LT(index, Points);
      ++counts[index];
    }
  }
  double chiSquare = 0.;
  constexpr double Expected = double(Draws) / Points;
  for (const int count : counts)
  {
    chiSquare += (count - Expected) * (count - Expected) / Expected;
  }
  // 199 degrees of freedom: mean 199, standard deviation 20.
  EXPECT_LT(chiSquare, 199. + 6. * 20.);
  EXPECT_GT(chiSquare, 199. - 6. * 20.);
}

// Batches have the size asked for, whatever the sizes of cloud and earlier batches.
TEST(SampleStream, BatchesAreComplete)
{
  for (const std::size_t pointCount : { 1, 2, 7, 5000 })
  {
    const std::vector<Vector4> points = numberedPoints(pointCount);
    SampleStream stream(points, 1);
    for (const std::size_t count : { 100, 1, 16384, 3, 4097 })
    {
      const std::vector<std::size_t> indices = drawIndices(stream, count);
      EXPECT_EQ(indices.size(), count);
      EXPECT_LT(*std::max_element(indices.begin(), indices.end()), pointCount);
    }
  }
}

// The same seed gives the same samples in the same order, another seed others.
TEST(SampleStream, SeedDecides)
{
  const std::vector<Vector4> points = numberedPoints(10000);
  SampleStream first(points, 8), second(points, 8), other(points, 9);
  for (int batch = 0; batch < 5; ++batch)
  {
    const auto samples = drawIndices(first, 256);
    EXPECT_EQ(drawIndices(second, 256), samples);
    EXPECT_NE(drawIndices(other, 256), samples);
  }
}

// A batch follows the order of the cloud, but for samples very close to each other in it.
TEST(SampleStream, BatchesFollowTheCloud)
{
  constexpr std::size_t Points = 100000;
  constexpr std::size_t Batch = 4096;
  const std::vector<Vector4> points = numberedPoints(Points);
  SampleStream stream(points, 2);
  const std::vector<std::size_t> indices = drawIndices(stream, Batch);
  std::size_t highest = 0;
  for (const std::size_t index : indices)
  {
    EXPECT_LT(highest, index + 2 * Points / Batch);
    highest = std::max(highest, index);
  }
  EXPECT_LT(indices.front(), Points / 100);
  EXPECT_GT(indices.back(), Points - Points / 100);
}

// With weights, points are drawn in proportion to them, and batches are as without.
TEST(SampleStream, Weighted)
{
  constexpr std::size_t Draws = 100000;
  const std::vector<Vector4> points = numberedPoints(100);
  std::vector<float> weights(100, 1.f);
  std::fill(weights.begin(), weights.begin() + 50, 0.f);
  weights[80] = 50.f;
  SampleStream stream(points, 6, weights), other(points, 6, weights);
  const std::vector<std::size_t> indices = drawIndices(stream, Draws);
  EXPECT_GE(*std::min_element(indices.begin(), indices.end()), 50u);
  const auto count = std::count(indices.begin(), indices.end(), std::size_t(80));
  EXPECT_NEAR(double(count) / double(Draws), 50. / 99., 0.01);
  EXPECT_EQ(drawIndices(other, Draws), indices);
}
}
