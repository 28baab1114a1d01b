// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "cloud/CloudSelection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
std::vector<Eigen::Vector3d> cubeCloud(std::size_t count)
{
  Random random(11);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& point : points)
  {
    point = { random.uniform(), random.uniform(), random.uniform() };
  }
  return points;
}

std::vector<Eigen::Vector3d> taken(
  const CloudSelection& selection, std::span<const Eigen::Vector3d> points)
{
  std::vector<Eigen::Vector3d> result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result),
    [&](const Eigen::Vector3d& point) { return selection.takes(point); });
  return result;
}

std::vector<Eigen::Vector3d> arranged(
  const CloudSelection& selection, std::span<const Eigen::Vector3d> points)
{
  std::vector<Eigen::Vector3d> result;
  for (const std::size_t place : selection.arrange(points, std::less<>()))
  {
    result.push_back(points[place]);
  }
  return result;
}
}

// About as many points are taken as are wanted: within six standard deviations.
TEST(CloudSelection, TakesAboutAsManyAsWanted)
{
  const std::vector<Eigen::Vector3d> points = cubeCloud(100000);
  for (const std::size_t wanted : { std::size_t(100), std::size_t(10000), std::size_t(90000) })
  {
    const CloudSelection selection(1, points.size(), wanted);
    const auto count = double(taken(selection, points).size());
    EXPECT_NEAR(count, double(wanted), 6. * std::sqrt(double(wanted)));
    EXPECT_FALSE(selection.takesAll());
  }
}

// Of a cloud that has no more points than are wanted all are taken, however many are on one spot.
TEST(CloudSelection, TakesAllOfFew)
{
  std::vector<Eigen::Vector3d> points = cubeCloud(1000);
  points.resize(4000, Eigen::Vector3d::Zero());
  const CloudSelection selection(1, points.size(), points.size());
  EXPECT_TRUE(selection.takesAll());
  EXPECT_EQ(taken(selection, points).size(), points.size());
  EXPECT_EQ(arranged(selection, points).size(), points.size());
}

// What is taken, and in which order, depends neither on the order of the points nor on the parts
// that they lie in.
TEST(CloudSelection, IndependentOfOrderAndParts)
{
  std::vector<Eigen::Vector3d> points = cubeCloud(20000);
  points.resize(25000, Eigen::Vector3d(1., 2., 3.));
  points.insert(points.end(), points.begin(), points.begin() + 5000);
  const CloudSelection selection(3, points.size(), 2000);
  const std::vector<Eigen::Vector3d> whole = arranged(selection, taken(selection, points));

  std::vector<Eigen::Vector3d> reversed(points.rbegin(), points.rend());
  EXPECT_EQ(arranged(selection, taken(selection, reversed)), whole);

  std::vector<Eigen::Vector3d> fromParts;
  const std::span<const Eigen::Vector3d> all(reversed);
  for (const auto& part : { all.first(7000), all.subspan(7000, 100), all.subspan(7100) })
  {
    const std::vector<Eigen::Vector3d> ofPart = arranged(selection, taken(selection, part));
    fromParts.insert(fromParts.end(), ofPart.begin(), ofPart.end());
  }
  EXPECT_EQ(arranged(selection, fromParts), whole);
}

// Wherever a part of the cloud lies, the same share of it is taken.
TEST(CloudSelection, EvenInSpace)
{
  const std::vector<Eigen::Vector3d> points = cubeCloud(100000);
  const CloudSelection selection(5, points.size(), 20000);
  std::vector<double> counts(8, 0.), all(8, 0.);
  for (const Eigen::Vector3d& point : points)
  {
    const std::size_t octant =
      std::size_t(point[0] > .5) + 2 * std::size_t(point[1] > .5) + 4 * std::size_t(point[2] > .5);
    ++all[octant];
    counts[octant] += selection.takes(point) ? 1. : 0.;
  }
  for (std::size_t octant = 0; octant < 8; ++octant)
  {
    const double expected = all[octant] * .2;
    EXPECT_NEAR(counts[octant], expected, 5. * std::sqrt(expected * .8));
  }
}

// Another seed takes others; a larger share of the same seed takes the same and more.
TEST(CloudSelection, SeedsAndShares)
{
  const std::vector<Eigen::Vector3d> points = cubeCloud(20000);
  const CloudSelection first(1, 20000, 5000), other(2, 20000, 5000), larger(1, 20000, 8000);
  std::size_t both = 0;
  for (const Eigen::Vector3d& point : points)
  {
    both += first.takes(point) && other.takes(point) ? 1u : 0u;
    EXPECT_TRUE(!first.takes(point) || larger.takes(point));
  }
  EXPECT_NEAR(double(both), 1250., 6. * std::sqrt(1250.));
}

// A spot with very many points does not fill the selection; of its points the first are kept.
TEST(CloudSelection, FewOnOneSpot)
{
  std::vector<Eigen::Vector3d> points(5000, Eigen::Vector3d(0., -0., 0.));
  points.resize(7000, Eigen::Vector3d(-0., 0., 0.));
  const CloudSelection selection(1, 100000, 50000);
  const auto places = selection.arrange(points, std::greater<>());
  ASSERT_EQ(places.size(), CloudSelection::MostOnOneSpot);
  EXPECT_EQ(places.front(), 6999u);
  EXPECT_EQ(places.back(), 6000u);
}
}
