// SPDX-License-Identifier: BSD-3-Clause
#include "start/LocalLayer.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// The sum of twelve uniform numbers: nearly normal, of standard deviation 1.
double normal(Random& random)
{
  double sum = -6.;
  for (int i = 0; i < 12; ++i)
  {
    sum += random.uniform();
  }
  return sum;
}

std::vector<Vector4> disk(Random& random, int count, double height, double noise)
{
  std::vector<Vector4> points;
  while (points.size() < std::size_t(count))
  {
    const double x = 2. * random.uniform() - 1., y = 2. * random.uniform() - 1.;
    if (x * x + y * y < 1.)
    {
      points.emplace_back(float(x), float(y), float(height + noise * normal(random)));
    }
  }
  return points;
}

LocalLayer layerAt(Vector4 place, const std::vector<Vector4>& points)
{
  const NearestPoints nearest(points);
  std::vector<NearPoint> found(std::min(points.size(), MostPointsOfLayer));
  nearest.find(place, found);
  return localLayer(place, points, found);
}
}

// Keeps the promise: a place in noise is moved onto the plane, the closer the more points tell; and the
// normal is that of the plane.
TEST(LocalLayer, TakesAwayNoise)
{
  constexpr double Noise = 0.1;
  Random random(1);
  double before = 1.;
  for (const int count : { 16, 32, 64 })
  {
    double squares = 0., turns = 0.;
    constexpr int Times = 400;
    for (int i = 0; i < Times; ++i)
    {
      const std::vector<Vector4> points = disk(random, count, 0., Noise);
      const LocalLayer layer = layerAt({ 0.f, 0.f, float(Noise * normal(random)) }, points);
      squares += double(layer.position[2] * layer.position[2]);
      turns += std::sqrt(1. - std::min(1., double(layer.normal[2] * layer.normal[2])));
    }
    const double error = std::sqrt(squares / Times) / Noise;
    EXPECT_LT(error, before);
    EXPECT_LT(turns / Times, 0.15);
    before = error;
  }
  EXPECT_LT(before, 0.35);
}

// Keeps the promise: of two layers the place goes onto its own, though the other is closer than points
// are.
TEST(LocalLayer, KeepsToItsOwnLayer)
{
  Random random(2);
  int right = 0;
  for (int i = 0; i < 50; ++i)
  {
    std::vector<Vector4> points = disk(random, 32, 0., 0.01);
    const std::vector<Vector4> other = disk(random, 32, 0.2, 0.01);
    points.insert(points.end(), other.begin(), other.end());
    right += std::abs(layerAt({ 0.f, 0.f, 0.f }, points).position[2]) < 0.03f ? 1 : 0;
    right += std::abs(layerAt({ 0.f, 0.f, 0.2f }, points).position[2] - 0.2f) < 0.03f ? 1 : 0;
  }
  // Now and then chance tilts the plane of so few.
  EXPECT_GE(right, 95);
}

// Keeps the promise: two layers are told as such where they are almost as far apart as the points that tell, and
// one is not taken for two.
TEST(LocalLayer, TellsTwoFromOne)
{
  Random random(4);
  int two = 0, one = 0;
  for (int i = 0; i < 50; ++i)
  {
    std::vector<Vector4> points = disk(random, 48, 0., 0.05);
    std::vector<NearPoint> found(48);
    NearestPoints(points).find({}, found);
    one += layerOfTwo({}, points, found) ? 0 : 1;
    const std::vector<Vector4> other = disk(random, 48, 0.6, 0.05);
    points.insert(points.end(), other.begin(), other.end());
    found.resize(points.size());
    NearestPoints(points).find({}, found);
    const auto layer = layerOfTwo({}, points, found);
    two += layer && std::abs(layer->position[2]) < 0.05f ? 1 : 0;
  }
  EXPECT_GE(one, 48);
  EXPECT_GE(two, 48);
}

// Keeps the promise: points on a line are told by their breadth.
TEST(LocalLayer, TellsLines)
{
  Random random(3);
  std::vector<Vector4> line;
  for (int i = 0; i < 16; ++i)
  {
    line.emplace_back(float(i) - 8.f, float(0.01 * normal(random)), float(0.01 * normal(random)));
  }
  EXPECT_LT(layerAt({ 0.f, 0.f, 0.f }, line).breadth, 0.05f);
  EXPECT_GT(layerAt({ 0.f, 0.f, 0.f }, disk(random, 16, 0., 0.01)).breadth, 0.2f);
}
}
