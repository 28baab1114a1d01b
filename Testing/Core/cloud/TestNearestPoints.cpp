// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/NearestPoints.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
Vector4 anywhere(Random& random)
{
  return { float(random.uniform()), float(random.uniform()), float(random.uniform()) };
}

/// Of very different density, some of them on the same spot.
std::vector<Vector4> unevenPoints(std::size_t count)
{
  Random random(1);
  std::vector<Vector4> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector4 point = anywhere(random);
    points.push_back(i % 3 == 0 ? point : i % 3 == 1 ? 0.001f * point : Vector4(0.5f, 0.f, 0.f));
  }
  return points;
}

std::vector<NearPoint> byHand(const std::vector<Vector4>& points, Vector4 place)
{
  std::vector<NearPoint> all;
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    all.push_back({ squaredNorm(points[i] - place), i });
  }
  std::sort(all.begin(), all.end());
  return all;
}
}

// Keeps the promise: the nearest, in order, as a look at all points finds them; less if there are not so
// many.
TEST(NearestPoints, AreThoseOfALookAtAll)
{
  Random random(2);
  for (const std::size_t count : { 0, 1, 7, 8, 9, 63, 64, 65, 1000, 5000 })
  {
    const std::vector<Vector4> points = unevenPoints(count);
    const NearestPoints nearest(points);
    for (int i = 0; i < 50; ++i)
    {
      const Vector4 place = i % 2 == 0 ? anywhere(random) : 0.002f * anywhere(random);
      std::vector<NearPoint> found(20);
      found.resize(nearest.find(place, found));
      std::vector<NearPoint> expected = byHand(points, place);
      expected.resize(std::min<std::size_t>(20, count));
      EXPECT_EQ(found, expected);
    }
  }
}

// Keeps the promise: other places with points, each once however many lie there.
TEST(NearestPoints, PlacesCountOnce)
{
  Random random(1);
  std::vector<Vector4> places, points;
  for (int i = 0; i < 500; ++i)
  {
    places.push_back(anywhere(random));
    points.insert(points.end(), 1 + std::size_t(i) % 9, places.back());
  }
  const NearestPoints nearest(points);
  for (const Vector4& place : places)
  {
    std::array<NearPoint, 6> found;
    ASSERT_EQ(nearest.findPlaces(place, found), found.size());
    const std::vector<NearPoint> expected = byHand(places, place);
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      // The first is the place itself.
      ASSERT_EQ(points[found[i].index][0], places[expected[i + 1].index][0]);
    }
  }
  std::array<NearPoint, 6> found;
  EXPECT_EQ(NearestPoints(std::vector<Vector4>(1000, places[0])).findPlaces(places[0], found), 0u);
  EXPECT_EQ(nearest.findPlaces(places[0], {}), 0u);
}

// Keeps the promise: of a point the places are the same as of where it lies.
TEST(NearestPoints, PlacesOfAPointAreThoseOfItsPlace)
{
  for (const std::size_t count : { 1, 7, 9, 65, 3000 })
  {
    const std::vector<Vector4> points = unevenPoints(count);
    const NearestPoints nearest(points);
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      std::vector<NearPoint> found(7), expected(7);
      found.resize(nearest.findPlaces(i, found));
      expected.resize(nearest.findPlaces(points[i], expected));
      ASSERT_EQ(found, expected);
    }
  }
}

// Keeps the promise: all points within a radius, each once.
TEST(NearestPoints, WithinARadiusAreAll)
{
  Random random(3);
  const std::vector<Vector4> points = unevenPoints(3000);
  const NearestPoints nearest(points);
  for (int i = 0; i < 100; ++i)
  {
    const Vector4 place = anywhere(random);
    const auto radius = float(0.5 * random.uniform());
    std::vector<NearPoint> found;
    nearest.forEachWithin(place, radius,
      [&](std::uint32_t index, float squared) {
        found.push_back({ squared, index });
      });
    std::sort(found.begin(), found.end());
    std::vector<NearPoint> expected = byHand(points, place);
    std::erase_if(
      expected, [&](const NearPoint& point) { return point.squaredDistance > radius * radius; });
    EXPECT_EQ(found, expected);
  }
}
}
