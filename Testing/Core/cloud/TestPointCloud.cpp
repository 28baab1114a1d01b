// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointCloud.h"

#include "base/Random.h"
#include "ExecutorToInterrupt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
Eigen::Vector3d randomInCube(Random& random)
{
  const double x = random.uniform(), y = random.uniform(), z = random.uniform();
  return { x, y, z };
}

std::vector<Eigen::Vector3d> cube(std::size_t count, std::uint64_t seed = 1)
{
  Random random(seed);
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(randomInCube(random));
  }
  return points;
}

template <typename Change>
std::vector<Eigen::Vector3d> changed(std::vector<Eigen::Vector3d> points, Change change)
{
  for (Eigen::Vector3d& point : points)
  {
    change(point);
  }
  return points;
}

bool sameCoordinates(Vector4 a, Vector4 b) { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }

/// How often it is asked to run parts, however many.
class StepCounter final : public Executor
{
public:
  unsigned threadCount() const override { return 1; }
  std::size_t count() const { return count_; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    ++count_;
    for (std::size_t i = 0; i < count; ++i)
    {
      part(context, i);
    }
  }

private:
  mutable std::size_t count_ = 0;
};

/// Compares the clouds of points and of the same points shuffled.
void expectSameSequence(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<Eigen::Vector3d> shuffled = points;
  Random random(11);
  for (std::size_t left = shuffled.size(); left > 1; --left)
  {
    std::swap(shuffled[left - 1], shuffled[random.below(std::uint32_t(left))]);
  }
  const PointCloud a(points), b(shuffled);
  ASSERT_EQ(a.points().size(), b.points().size());
  for (std::size_t i = 0; i < a.points().size(); ++i)
  {
    ASSERT_TRUE(sameCoordinates(a.points()[i], b.points()[i])) << "point " << i;
  }
}
}

// Points that are not finite are dropped and counted; the rest is as without them.
TEST(PointCloud, DropsWhatIsNotFinite)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Eigen::Vector3d> clean = cube(1000);
  std::vector<Eigen::Vector3d> dirty = clean;
  dirty.insert(dirty.begin(), { nan, 0., 0. });
  dirty.insert(dirty.begin() + 500, { 0., infinity, 0. });
  dirty.insert(dirty.begin() + 700, { 0., 0., -infinity });
  dirty.push_back({ nan, nan, nan });

  const PointCloud cloud(dirty), expected(clean);
  EXPECT_EQ(cloud.droppedCount(), 4u);
  EXPECT_EQ(expected.droppedCount(), 0u);
  ASSERT_EQ(cloud.points().size(), 1000u);
  for (std::size_t i = 0; i < 1000; ++i)
  {
    EXPECT_TRUE(sameCoordinates(cloud.points()[i], expected.points()[i]));
  }
}

// Nothing, or nothing finite, is a cloud without extent.
TEST(PointCloud, EmptyHasNoExtent)
{
  const PointCloud empty(std::vector<Eigen::Vector3d>{});
  EXPECT_FALSE(empty.hasExtent());
  EXPECT_EQ(empty.points().size(), 0u);
  const PointCloud nothing(
    std::vector<Eigen::Vector3d>(3, Eigen::Vector3d::Constant(std::nan(""))));
  EXPECT_FALSE(nothing.hasExtent());
  EXPECT_EQ(nothing.droppedCount(), 3u);
}

// Finite points whose extent is no number are dropped, all of them: there is nothing to learn from.
TEST(PointCloud, ExtentBeyondAllNumbersIsNone)
{
  const double most = std::numeric_limits<double>::max();
  const std::vector<Eigen::Vector3d> points{ { most, 1., 0. }, { -most, 0., 1. },
    { 0.7 * most, 3., 0. } };
  const PointCloud cloud(points);
  EXPECT_FALSE(cloud.hasExtent());
  EXPECT_TRUE(cloud.points().empty());
  EXPECT_EQ(cloud.droppedCount(), 3u);
}

// Points on one spot have no extent, wherever it is; two spots have.
TEST(PointCloud, CoincidingPointsHaveNoExtent)
{
  for (const double offset : { 0., 1., 1e7, -1e300 })
  {
    const PointCloud cloud(std::vector<Eigen::Vector3d>(100, Eigen::Vector3d::Constant(offset)));
    EXPECT_FALSE(cloud.hasExtent()) << offset;
    EXPECT_EQ(cloud.points().size(), 100u);
  }
  const PointCloud single(std::vector<Eigen::Vector3d>{ { 1., 2., 3. } });
  EXPECT_FALSE(single.hasExtent());
  std::vector<Eigen::Vector3d> spots(1000, Eigen::Vector3d::Zero());
  spots[17] = { 1., 0., 0. };
  const PointCloud two(spots);
  EXPECT_TRUE(two.hasExtent());
  EXPECT_NEAR(two.diagonal() * two.unit(), 1., 1e-9);
}

// The bulk comes to about unit size around the origin, inside its box.
TEST(PointCloud, BulkHasUnitSize)
{
  const auto points =
    changed(cube(5000), [](Eigen::Vector3d& p) { p = 300. * p + Eigen::Vector3d(10., -70., 1e4); });
  const PointCloud cloud(points);
  EXPECT_GT(cloud.diagonal(), 1.);
  EXPECT_LT(cloud.diagonal(), 1.1);
  Eigen::AlignedBox3d box;
  for (const Vector4 point : cloud.points())
  {
    box.extend(point.toDouble());
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_GE(point[axis], cloud.bulkMin()[axis]);
      EXPECT_LE(point[axis], cloud.bulkMax()[axis]);
    }
  }
  EXPECT_LT(box.center().norm(), 0.02);
  EXPECT_NEAR(cloud.unit(), 300. * std::sqrt(3.), 0.03 * 300. * std::sqrt(3.));
}

// A huge offset costs no precision: points come back to within 1e-6 of the extent.
TEST(PointCloud, HugeOffsetSurvives)
{
  const Eigen::Vector3d offset(1e7, -1e7, 1e7);
  const auto points = changed(cube(2000), [&](Eigen::Vector3d& p) { p += offset; });
  const PointCloud cloud(points);
  EXPECT_EQ(cloud.points().size(), 2000u);
  for (const Eigen::Vector3d& point : points)
  {
    EXPECT_LT((cloud.toInput(cloud.fromInput(point)) - point).norm(), 1e-6);
  }
  for (std::size_t i = 0; i < cloud.points().size(); i += 100)
  {
    const Eigen::Vector3d back = cloud.toInput(cloud.points()[i]);
    double least = 1.;
    for (const Eigen::Vector3d& point : points)
    {
      least = std::min(least, (point - back).norm());
    }
    EXPECT_LT(least, 1e-6);
  }
}

// Units do not matter: a cloud of any size comes out as that of size one.
TEST(PointCloud, AnyExtent)
{
  const std::vector<Eigen::Vector3d> points = cube(2000);
  const PointCloud expected(points);
  for (const double size : { 1e-30, 1e-10, 1e10, 1e30 })
  {
    const auto scaled = changed(points, [&](Eigen::Vector3d& p) { p *= size; });
    const PointCloud cloud(scaled);
    EXPECT_TRUE(cloud.hasExtent()) << size;
    EXPECT_EQ(cloud.droppedCount(), 0u) << size;
    EXPECT_NEAR(cloud.diagonal(), expected.diagonal(), 1e-9) << size;
    EXPECT_NEAR(cloud.unit() / size, expected.unit(), 1e-9) << size;
    for (std::size_t i = 0; i < 2000; i += 50)
    {
      EXPECT_LT((cloud.points()[i] - expected.points()[i]).toDouble().norm(), 1e-6) << size;
      EXPECT_LT((cloud.toInput(cloud.fromInput(scaled[i])) - scaled[i]).norm(), 1e-6 * size);
    }
  }
}

// A few points that are very far from all others are left out, wherever they are in the input, and are
// counted: the cloud is that without them.
TEST(PointCloud, FarOutliers)
{
  const double large = std::numeric_limits<double>::max();
  for (const std::size_t size : { 100u, 2000u, 200000u })
  {
    const std::vector<Eigen::Vector3d> points = cube(size);
    const PointCloud plain(points, {}, true);
    EXPECT_TRUE(plain.farPoints().empty());
    for (const double distance : { 5., 20., 1e3, 3. * PointCloud::FarthestPoint, 1e200, large })
    {
      for (const std::size_t count : { 1u, 5u, 20u })
      {
        SCOPED_TRACE(std::to_string(size) + ", " + std::to_string(distance));
        auto far = points;
        Random random(size);
        for (std::size_t i = 0; i < std::min(count, size / 20); ++i)
        {
          const Eigen::Vector3d direction = randomInCube(random) - Eigen::Vector3d::Constant(0.5);
          far.emplace_back(distance * direction / direction.cwiseAbs().maxCoeff());
        }
        const PointCloud cloud(far, {}, true);
        ASSERT_EQ(cloud.farPoints().size(), far.size() - size);
        EXPECT_EQ(cloud.farPoints().front(), size);
        EXPECT_EQ(cloud.droppedCount(), 0u);
        EXPECT_EQ(cloud.unit(), plain.unit());
        EXPECT_EQ(cloud.diagonal(), plain.diagonal());
        ASSERT_EQ(cloud.points().size(), size);
        for (std::size_t i = 0; i < size; ++i)
        {
          ASSERT_TRUE(sameCoordinates(cloud.points()[i], plain.points()[i]));
        }
        EXPECT_TRUE(std::ranges::equal(cloud.origins(), plain.origins()));
      }
    }
  }
}

// More of them, and what goes on outwards step by step, are of the cloud; what is then beyond FarthestPoint
// is dropped, and leaves the bulk as large as it was.
TEST(PointCloud, FarPartsStay)
{
  const std::vector<Eigen::Vector3d> points = cube(20000);
  const auto body =
    changed(cube(200, 2), [](Eigen::Vector3d& point) { point += Eigen::Vector3d(100., 0., 0.); });
  auto both = points;
  both.insert(both.end(), body.begin(), body.end());
  EXPECT_EQ(PointCloud(both).points().size(), both.size());

  auto line = points;
  for (double distance = 1.5; distance < 1e7; distance *= 3.)
  {
    line.emplace_back(distance, 0., 0.);
  }
  const PointCloud cloud(line), plain(points);
  EXPECT_TRUE(cloud.farPoints().empty());
  EXPECT_EQ(cloud.droppedCount(), 2u);
  EXPECT_GT(cloud.diagonal(), 1000.);
  EXPECT_NEAR(cloud.unit(), plain.unit(), 0.01 * plain.unit());
  EXPECT_LT((cloud.bulkMax() - cloud.bulkMin()).toDouble().norm(), 2.);

  // All on one spot but one: that one is what tells an extent.
  std::vector<Eigen::Vector3d> spot(1000, Eigen::Vector3d(1., 2., 3.));
  spot.emplace_back(4., 2., 3.);
  EXPECT_TRUE(PointCloud(spot).hasExtent());
}

// The step of single precision is that of the input where it has such numbers, however they come.
TEST(PointCloud, FloatStep)
{
  const double step = std::numeric_limits<float>::epsilon();
  const auto far = changed(cube(1000), [](Eigen::Vector3d& point) { point.x() += 500.; });
  const auto rounded =
    changed(far, [](Eigen::Vector3d& point) { point = point.cast<float>().cast<double>(); });
  EXPECT_EQ(PointCloud(cube(1000)).floatStep(), step);
  EXPECT_EQ(PointCloud(far).floatStep(), step);
  EXPECT_NEAR(PointCloud(rounded).floatStep(), 501. * step / PointCloud(rounded).unit(), step);
}

// The order of the input does not matter: shuffled, the points come in the same sequence.
TEST(PointCloud, OrderOfInputDoesNotMatter)
{
  expectSameSequence(cube(5000, 3));
  expectSameSequence(changed(cube(5000, 3),
    [](Eigen::Vector3d& p) { p = (p - Eigen::Vector3d::Constant(0.5)).normalized(); }));
}

// Nor does it where there are many points.
TEST(PointCloud, OrderOfManyPointsDoesNotMatter) { expectSameSequence(cube(70000, 3)); }

// Points come in an order in which neighbours are close to each other in space.
TEST(PointCloud, NeighborsInOrderAreNeighborsInSpace)
{
  const PointCloud cloud(cube(8000, 4));
  double steps = 0.;
  for (std::size_t i = 0; i + 1 < cloud.points().size(); ++i)
  {
    steps += (cloud.points()[i + 1] - cloud.points()[i]).toDouble().norm();
  }
  // At random the mean step would be 0.38 of the cube's diagonal; 8000 points are 0.03 apart.
  EXPECT_LT(steps / double(cloud.points().size()), 0.08);
}

// They do where most points are in a place so small that all else is far away.
TEST(PointCloud, NeighborsInACrowdAreNeighborsInSpace)
{
  constexpr double Width = 1e-5;
  std::vector<Eigen::Vector3d> points = cube(200, 6);
  for (const Eigen::Vector3d& point : cube(8000, 4))
  {
    points.emplace_back(Width * point);
  }
  const PointCloud cloud(points);
  double steps = 0., crowd = 0.;
  for (std::size_t i = 0; i + 1 < cloud.points().size(); ++i)
  {
    const double step =
      (cloud.toInput(cloud.points()[i + 1]) - cloud.toInput(cloud.points()[i])).norm();
    steps += step < 2. * Width ? step : 0.;
    crowd += step < 2. * Width ? 1. : 0.;
  }
  EXPECT_GT(crowd, 7900.);
  EXPECT_LT(steps / crowd, 0.2 * Width);
}

// A cloud that keeps origins knows where each point comes from; it is the same cloud all the same.
TEST(PointCloud, Origins)
{
  std::vector<Eigen::Vector3d> points = cube(3000);
  points[7].x() = std::numeric_limits<double>::quiet_NaN();
  points[70].y() = 1e9;
  const PointCloud plain(points), cloud(points, {}, true);
  EXPECT_TRUE(plain.origins().empty());
  ASSERT_EQ(cloud.origins().size(), cloud.points().size());
  EXPECT_EQ(cloud.droppedCount(), 1u);
  EXPECT_TRUE(std::ranges::equal(cloud.farPoints(), std::array{ 70u }));
  for (std::size_t i = 0; i < cloud.points().size(); ++i)
  {
    ASSERT_TRUE(sameCoordinates(cloud.points()[i], plain.points()[i]));
    ASSERT_TRUE(sameCoordinates(cloud.points()[i], cloud.fromInput(points[cloud.origins()[i]])));
  }
}

// Points without a positive weight are not there, whatever they are; the others keep the ratios of
// their weights, which are 1 on average, up to the largest numbers.
TEST(PointCloud, Weights)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double scale : { 1., 1e-300, 1e303 })
  {
    std::vector<Eigen::Vector3d> points = cube(2000);
    std::vector<double> weights;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      weights.push_back(scale * double(1 + i % 5));
    }
    const std::vector<Eigen::Vector3d> kept = points;
    for (const double weight : { 0., -1., std::nan(""), infinity })
    {
      points.emplace_back(1e3, weight, 0.);
      weights.push_back(weight);
    }
    const PointCloud plain(kept), cloud(points, weights, true);
    EXPECT_TRUE(plain.weights().empty());
    EXPECT_EQ(cloud.droppedCount(), 0u);
    ASSERT_EQ(cloud.points().size(), kept.size());
    ASSERT_EQ(cloud.weights().size(), kept.size());
    double sum = 0.;
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
      ASSERT_TRUE(sameCoordinates(cloud.points()[i], plain.points()[i]));
      ASSERT_NEAR(double(cloud.weight(i)), double(1 + cloud.origins()[i] % 5) / 3., 1e-6);
      sum += double(cloud.weight(i));
    }
    EXPECT_NEAR(sum / double(kept.size()), 1., 1e-6);
  }
}

// Without some of its points it is the same cloud otherwise: origins, weights and units.
TEST(PointCloud, Without)
{
  const std::vector<Eigen::Vector3d> points = cube(1000, 5);
  std::vector<double> weights(points.size(), 1.);
  weights[0] = 3.;
  const PointCloud cloud(points, weights, true);
  const PointCloud rest = cloud.without([](Vector4 point) { return point[0] > 0.f; });
  EXPECT_EQ(rest.unit(), cloud.unit());
  EXPECT_LE(rest.bulkMax()[0], 0.f);
  EXPECT_GE(rest.bulkMin()[1], cloud.bulkMin()[1]);
  ASSERT_EQ(rest.origins().size(), rest.points().size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < cloud.points().size(); ++i)
  {
    if (cloud.points()[i][0] <= 0.f)
    {
      ASSERT_LT(next, rest.points().size());
      EXPECT_TRUE(sameCoordinates(rest.points()[next], cloud.points()[i]));
      EXPECT_EQ(rest.origins()[next], cloud.origins()[i]);
      EXPECT_EQ(rest.weight(next), cloud.weight(i));
      ++next;
    }
  }
  EXPECT_EQ(next, rest.points().size());
}

// Promise: who makes a large cloud is asked whether to go on again and again, in each of its steps: at least once for
// half a million points. An interruption leaves no cloud.
TEST(PointCloud, IsMadeInPartsThatMayBeInterrupted)
{
  constexpr std::size_t Many = 1000000;
  const std::vector<Eigen::Vector3d> points = cube(Many);
  const std::vector<double> weights(Many, 2.);
  const ExecutorToInterrupt whole(std::numeric_limits<std::size_t>::max());
  const PointCloud cloud(points, weights, true, whole);
  EXPECT_EQ(cloud.points().size(), Many);
  const StepCounter counter;
  EXPECT_EQ(PointCloud(points, weights, true, counter).points().size(), Many);
  // Points that are finite, three axes twice, distances, box, buckets twice, and weights twice.
  EXPECT_GT(counter.count(), 12 * Many / 500000);
  const std::size_t stride = std::max<std::size_t>(1, whole.partCount() / 8);
  for (std::size_t part = 0; part < whole.partCount(); part += stride)
  {
    const ExecutorToInterrupt executor(part);
    EXPECT_THROW(PointCloud(points, weights, true, executor), Interrupted) << part;
  }
}
}
