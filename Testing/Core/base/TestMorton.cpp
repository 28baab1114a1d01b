// SPDX-License-Identifier: BSD-3-Clause
#include "base/Morton.h"
#include "base/Random.h"
#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
/// In cells, which have 16 bits of each coordinate.
constexpr float LongestSide = 65535.f;

/// A box whose longest side is as long as it has cells, so that cells have whole coordinates.
struct CellBox
{
  Vector4 low, high;
};

using GridCell = std::array<std::uint32_t, 3>;

GridCell cellOf(const CellBox& box, Vector4 point)
{
  GridCell cell{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const float inside = std::clamp(point[axis], box.low[axis], box.high[axis]);
    cell[std::size_t(axis)] = std::uint32_t(std::floor(inside - box.low[axis]));
  }
  return cell;
}

/// Whether a comes before b: by the highest bit in which they differ, of equal ones by that of z, then
/// of y, then of x.
bool isBefore(const GridCell& a, const GridCell& b)
{
  std::size_t deciding = 2;
  for (const std::size_t axis : { 1u, 0u })
  {
    const auto isHigher =
      std::bit_width(a[axis] ^ b[axis]) > std::bit_width(a[deciding] ^ b[deciding]);
    deciding = isHigher ? axis : deciding;
  }
  return a[deciding] < b[deciding];
}

/// Points of one cell keep their order.
std::vector<std::uint32_t> expectedOrder(const CellBox& box, const std::vector<Vector4>& points)
{
  std::vector<GridCell> cells;
  for (const Vector4 point : points)
  {
    cells.push_back(cellOf(box, point));
  }
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return isBefore(cells[a], cells[b]); });
  return order;
}

/// Points at quarters of cells, in a box and so much beyond it on all sides.
std::vector<Vector4> randomPoints(
  const CellBox& box, std::size_t count, float beyond, Random& random)
{
  std::vector<Vector4> points;
  while (points.size() < count)
  {
    std::array<float, 3> at{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const float first = box.low[axis] - beyond, last = box.high[axis] + beyond;
      const auto quarters = std::uint32_t(4.f * (last - first)) + 1;
      at[std::size_t(axis)] = first + float(random.below(quarters)) / 4.f;
    }
    points.emplace_back(at[0], at[1], at[2]);
  }
  return points;
}
}

// However small or large the box, all points are in the order, once; those along its diagonal one
// after the other.
TEST(Morton, AnyExtent)
{
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  for (const float size : { 0.f, smallest, 1e-40f, 1e-30f, 1.f, 1e30f })
  {
    std::vector<Vector4> points;
    for (int i = 0; i <= 16; ++i)
    {
      const float place = size * float(i) / 16.f;
      points.emplace_back(place, place, place);
    }
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(mortonOrder(points, points.front(), points.back()), expected) << size;
  }
}

// The eight corners of a box come in the order of counting: x first, then y, then z.
TEST(Morton, Axes)
{
  std::vector<Vector4> corners;
  for (const float z : { 3.f, -2.f })
  {
    for (const float y : { 3.f, -2.f })
    {
      for (const float x : { 3.f, -2.f })
      {
        corners.emplace_back(x, y, z);
      }
    }
  }
  const std::vector<std::uint32_t> expected{ 7, 6, 5, 4, 3, 2, 1, 0 };
  EXPECT_EQ(mortonOrder(corners, corners.back(), corners.front()), expected);
}

// The order is that of the interleaved bits of the cells, wherever the box lies and however flat it
// is; points beyond it count as on its surface.
TEST(Morton, OrderOfInterleavedBits)
{
  Random random(1);
  for (const Vector4 low : { Vector4(), Vector4(-32768.f, -65535.f, 12.f) })
  {
    for (const Vector4 size : { Vector4(LongestSide, LongestSide, LongestSide),
           Vector4(1000.f, LongestSide, 77.f), Vector4(LongestSide, 40000.f, 0.f),
           Vector4(0.f, 3.f, LongestSide), Vector4(0.f, LongestSide, 0.f) })
    {
      const CellBox box{ low, low + size };
      for (const float beyond : { 0.f, 500.f })
      {
        const std::vector<Vector4> points = randomPoints(box, 2000, beyond, random);
        EXPECT_EQ(mortonOrder(points, box.low, box.high), expectedOrder(box, points));
      }
    }
  }
}

// Points on the same spot, or in the same cell, keep their order.
TEST(Morton, EqualCellsKeepTheirOrder)
{
  Random random(2);
  const CellBox box{ Vector4(-5.f, -5.f, -5.f), Vector4(65530.f, 65530.f, 65530.f) };
  const CellBox corner{ box.low, box.low + Vector4(3.f, 2.f, 1.f) };
  const std::vector<Vector4> points = randomPoints(corner, 2000, 0.f, random);
  EXPECT_EQ(mortonOrder(points, box.low, box.high), expectedOrder(box, points));
  const std::vector<Vector4> same(100, Vector4(7.f, 8.f, 9.f));
  std::vector<std::uint32_t> asBefore(same.size());
  std::iota(asBefore.begin(), asBefore.end(), 0u);
  EXPECT_EQ(mortonOrder(same, box.low, box.high), asBefore);
  EXPECT_EQ(mortonOrder(same, same.front(), same.front()), asBefore);
  EXPECT_TRUE(mortonOrder({}, box.low, box.high).empty());
}

// So many points that several threads sort them are in the same order.
TEST(Morton, ManyPoints)
{
  Random random(3);
  const CellBox box{ Vector4(-100.f, 0.f, 0.f), Vector4(65435.f, 300.f, 65535.f) };
  const std::vector<Vector4> points = randomPoints(box, 300000, 0.f, random);
  const std::vector<std::uint32_t> expected = expectedOrder(box, points);
  EXPECT_TRUE(mortonOrder(points, box.low, box.high) == expected);
  EXPECT_TRUE(mortonOrder(points, box.low, box.high, ThreadPool(3)) == expected);
}
}
