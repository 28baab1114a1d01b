// SPDX-License-Identifier: BSD-3-Clause
// Promise: of many points at one place, as depth cameras leave for what they have not seen, one stays, and the cloud is
// as if there had been one; a cloud in which each point is there many times stays as it is.
#include "cloud/Piles.h"

#include "base/Random.h"
#include "base/ThreadPool.h"
#include "cloud/PointCloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
using Points = std::vector<Eigen::Vector3d>;

/// Points in a cube at some place.
Points cubeAt(const Eigen::Vector3d& corner, std::size_t count)
{
  Random random(3);
  Points points;
  while (points.size() < count)
  {
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    points.push_back(corner + Eigen::Vector3d(x, y, z));
  }
  return points;
}

/// The points, and others behind every so many of them.
Points mixed(const Points& points, const Eigen::Vector3d& place, std::size_t count)
{
  Points all;
  const std::size_t each = points.size() / count + 1;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    all.push_back(points[i]);
    if (i % each == 0)
    {
      all.push_back(place);
      --count;
    }
  }
  all.insert(all.end(), count, place);
  return all;
}

void expectSame(const PointCloud& a, const PointCloud& b)
{
  EXPECT_EQ(a.unit(), b.unit());
  EXPECT_EQ(a.diagonal(), b.diagonal());
  EXPECT_EQ(a.floatStep(), b.floatStep());
  EXPECT_EQ(a.differentCount(), b.differentCount());
  EXPECT_EQ(a.droppedCount(), b.droppedCount());
  EXPECT_TRUE(std::ranges::equal(a.farPoints(), b.farPoints()));
  EXPECT_TRUE(std::ranges::equal(a.origins(), b.origins()));
  EXPECT_TRUE(std::ranges::equal(a.weights(), b.weights()));
  EXPECT_TRUE(std::ranges::equal(
    a.points(), b.points(), [](Vector4 p, Vector4 q) { return p.toDouble() == q.toDouble(); }));
}

Points times(const Points& points, std::size_t count)
{
  Points all;
  for (std::size_t i = 0; i < count; ++i)
  {
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}
}

// A pile beside a cloud, within it, or so far away that single precision does not tell the others apart: the cloud
// is that with the first point of the pile alone. On any number of threads.
TEST(Piles, OnePointStays)
{
  for (const Eigen::Vector3d& corner :
    { Eigen::Vector3d(2., 0., 1.), Eigen::Vector3d(-0.5, -0.5, -0.5),
      Eigen::Vector3d(3e5, 5e6, 100.), Eigen::Vector3d(0., 0., 1e9) })
  {
    SCOPED_TRACE(corner.transpose());
    const Points points = cubeAt(corner, 8500);
    const Points all = mixed(points, Eigen::Vector3d::Zero(), 1500);
    Points once = points;
    once.insert(once.begin() + 1, Eigen::Vector3d::Zero());
    const PointCloud cloud(all, {}, true), expected(once, {}, true);
    EXPECT_EQ(cloud.coincidingCount(), 1499u);
    EXPECT_EQ(cloud.droppedCount(), 1499u);
    EXPECT_EQ(cloud.pileCount(), 1u);
    EXPECT_EQ(cloud.largestPile().count, 1500u);
    EXPECT_EQ(cloud.largestPile().place, Eigen::Vector3d::Zero());
    EXPECT_EQ(cloud.unit(), expected.unit());
    EXPECT_EQ(cloud.diagonal(), expected.diagonal());
    EXPECT_EQ(cloud.farPoints().size(), expected.farPoints().size());
    ASSERT_EQ(cloud.points().size(), expected.points().size());
    for (std::size_t i = 0; i < cloud.points().size(); ++i)
    {
      ASSERT_EQ(cloud.points()[i].toDouble(), expected.points()[i].toDouble());
      ASSERT_EQ(all[cloud.origins()[i]], once[expected.origins()[i]]);
      ASSERT_TRUE(all[cloud.origins()[i]] != Eigen::Vector3d::Zero() || cloud.origins()[i] == 1);
    }
    expectSame(cloud, PointCloud(all, {}, true, ThreadPool(7)));
  }
}

// Some piles: all are found, whatever the largest one is, and the largest is told. Both zeros are one.
TEST(Piles, Several)
{
  Points all = cubeAt({ 1., 1., 1. }, 3000);
  all.insert(all.end(), 150, Eigen::Vector3d(1.5, 2., 1.));
  all.insert(all.end(), 90000, Eigen::Vector3d(-9999., -0., -9999.));
  all.insert(all.end(), 90000, Eigen::Vector3d(-9999., 0., -9999.));
  const PointCloud cloud(all);
  EXPECT_EQ(cloud.pileCount(), 2u);
  EXPECT_EQ(cloud.coincidingCount(), 149u + 179999u);
  EXPECT_EQ(cloud.largestPile().count, 180000u);
  EXPECT_EQ(cloud.largestPile().place, Eigen::Vector3d(-9999., 0., -9999.));
  EXPECT_FALSE(std::signbit(cloud.largestPile().place.y()));
}

// A hundred points, or ten times what is usual, are no pile; nor is a cloud of which each point is there many times,
// or that has few places at all.
TEST(Piles, RepeatedPointsAreNone)
{
  const Points points = cubeAt({ 0., 0., 0. }, 2000);
  for (const std::size_t count : { 3u, 150u })
  {
    const PointCloud cloud(times(points, count));
    EXPECT_EQ(cloud.points().size(), 2000u * count);
    EXPECT_EQ(cloud.pileCount(), 0u);
    EXPECT_EQ(cloud.droppedCount(), 0u);
  }
  const auto pilesWith = [](Points all, std::size_t count)
  {
    all.insert(all.end(), count, Eigen::Vector3d(0.5, 0.5, 0.5));
    return PointCloud(all).pileCount();
  };
  EXPECT_EQ(pilesWith(points, PileSearch::MostAtPlace), 0u);
  EXPECT_EQ(pilesWith(points, PileSearch::MostAtPlace + 1), 1u);
  EXPECT_EQ(pilesWith(times(points, 20), 190), 0u);
  EXPECT_EQ(pilesWith(times(points, 20), 210), 1u);
  EXPECT_EQ(pilesWith({ { 0., 0., 0. }, { 1., 2., 3. } }, 10000), 0u);
  EXPECT_EQ(PointCloud(Points(5000, Eigen::Vector3d::Ones())).pileCount(), 0u);
}

// Points that only single precision takes for one are no pile.
TEST(Piles, NearPlacesAreNone)
{
  Points all = cubeAt({ 0., 0., 0. }, 2000);
  for (int i = 0; i < 1000; ++i)
  {
    all.emplace_back(0.5 + 1e-12 * double(i), 0.5, 0.5);
  }
  EXPECT_EQ(PointCloud(all).pileCount(), 0u);
  all.insert(all.end(), 200, all.back());
  EXPECT_EQ(PointCloud(all).coincidingCount(), 200u);
}

// Points that only a pile makes few, and far from all others, are of the cloud.
TEST(Piles, WhatIsFarFromAPileStays)
{
  Points all = cubeAt({ 1., 1., 1. }, 30);
  for (const Eigen::Vector3d& point : cubeAt({ 0., 0., 0. }, 20))
  {
    all.emplace_back(0.01 * point);
  }
  all.insert(all.end(), 1000, Eigen::Vector3d::Zero());
  const PointCloud cloud(all);
  EXPECT_EQ(cloud.pileCount(), 1u);
  EXPECT_EQ(cloud.points().size(), 51u);
  EXPECT_TRUE(cloud.farPoints().empty());
}

// Of a pile, the first point with a weight stays, and keeps it; those without are not there, as ever.
TEST(Piles, Weights)
{
  const Points points = cubeAt({ 1., 0., 0. }, 1000);
  Points all = points;
  std::vector<double> weights(points.size(), 2.);
  for (int i = 0; i < 500; ++i)
  {
    all.emplace_back(0., 0., 0.);
    weights.push_back(i % 2 == 0 ? 0. : double(i));
  }
  const PointCloud cloud(all, weights, true);
  EXPECT_EQ(cloud.coincidingCount(), 249u);
  EXPECT_EQ(cloud.droppedCount(), 249u);
  Points once = points;
  once.emplace_back(0., 0., 0.);
  weights.resize(points.size());
  weights.push_back(1.);
  const PointCloud expected(once, weights, true);
  EXPECT_TRUE(std::ranges::equal(cloud.weights(), expected.weights()));
  EXPECT_EQ(std::ranges::count(cloud.origins(), 1001u), 1);
}
}
