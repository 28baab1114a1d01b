// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Delaunay.h"

#include "base/Morton.h"
#include "base/Random.h"
#include "mesh/BoxTree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// A product of five differences of coordinates of so many bits, and of one that is a square, still has
/// its place in 128 bits.
constexpr int GridBits = 22;
/// In cells of the grid: points are shifted by at most that.
constexpr std::uint32_t Shift = 16;
constexpr std::uint64_t Seed = 1;
constexpr int MostRounds = 24;
/// Tries to widen a hole that cannot be seen from the new point.
constexpr int MostWidenings = 8;

__extension__ using Wide = __int128;

int signOf(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// In rounds of growing size, each along a Morton curve: the search for a place is short, and yet no
/// order of the points makes many cells that soon go again (Amenta, Choi, Rote 2003).
std::vector<std::uint32_t> insertionOrder(std::span<const Vector4> points)
{
  Box box;
  std::for_each(points.begin(), points.end(), [&](Vector4 point) { box.extend(point); });
  const std::vector<std::uint32_t> along = mortonOrder(points, box.low, box.high);
  std::vector<std::vector<std::uint32_t>> rounds(MostRounds);
  const Random random(Seed);
  for (const std::uint32_t point : along)
  {
    const int round = std::countr_zero(random.ahead(point).next() | 1ull << (MostRounds - 1));
    rounds[std::size_t(round)].push_back(point);
  }
  std::vector<std::uint32_t> order;
  for (std::size_t i = rounds.size(); i-- > 0;)
  {
    order.insert(order.end(), rounds[i].begin(), rounds[i].end());
  }
  return order;
}
}

Delaunay::Delaunay(std::span<const Vector4> points)
{
  Box box;
  std::for_each(points.begin(), points.end(), [&](Vector4 point) { box.extend(point); });
  const Vector4 sides = points.empty() ? Vector4() : box.high - box.low;
  const double longest = double(std::max({ sides[0], sides[1], sides[2] }));
  if (!(longest > 0.))
  {
    return;
  }
  const double scale = double((1u << GridBits) - 2 * Shift) / longest;
  gridWidth_ = 1. / scale;
  points_.reserve(points.size());
  Random random(Seed, 1);
  for (const Vector4 point : points)
  {
    const Eigen::Vector3d p = scale * (point - box.low).toDouble();
    points_.push_back({ std::int32_t(p.x()) + std::int32_t(random.below(2 * Shift)),
      std::int32_t(p.y()) + std::int32_t(random.below(2 * Shift)),
      std::int32_t(p.z()) + std::int32_t(random.below(2 * Shift)) });
  }
  const std::vector<std::uint32_t> order = insertionOrder(points);
  if (!begin(order))
  {
    return;
  }
  for (const std::uint32_t point : order)
  {
    insert(std::int32_t(point));
  }
  dropUnused();
}

int Delaunay::orientation(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const
{
  const GridPoint &o = points_[std::size_t(a)], &p = points_[std::size_t(b)],
                  &q = points_[std::size_t(c)], &r = points_[std::size_t(d)];
  const double ux = p.x - o.x, uy = p.y - o.y, uz = p.z - o.z;
  const double vx = q.x - o.x, vy = q.y - o.y, vz = q.z - o.z;
  const double wx = r.x - o.x, wy = r.y - o.y, wz = r.z - o.z;
  // The minors are exact, their products with w are rounded.
  const double mx = uy * vz - uz * vy, my = uz * vx - ux * vz, mz = ux * vy - uy * vx;
  const double value = mx * wx + my * wy + mz * wz;
  const double error = 1e-15 * (std::abs(mx * wx) + std::abs(my * wy) + std::abs(mz * wz));
  if (std::abs(value) > error)
  {
    return value > 0. ? 1 : -1;
  }
  const auto wide = [](double x) { return Wide(std::int64_t(x)); };
  return signOf(wide(mx) * wide(wx) + wide(my) * wide(wy) + wide(mz) * wide(wz));
}

/// 1 if the point lies within the sphere of the cell, -1 if it is outside.
int Delaunay::inSphere(const Cell& cell, std::int32_t point) const
{
  const GridPoint& o = points_[std::size_t(point)];
  std::array<std::array<double, 3>, 4> d;
  std::array<double, 4> lift;
  for (std::size_t i = 0; i < 4; ++i)
  {
    const GridPoint& p = points_[std::size_t(cell.vertices[i])];
    d[i] = { double(p.x - o.x), double(p.y - o.y), double(p.z - o.z) };
    lift[i] = d[i][0] * d[i][0] + d[i][1] * d[i][1] + d[i][2] * d[i][2];
  }
  // Exact: two by two in x and y, for all pairs.
  const auto minor = [&](std::size_t i, std::size_t j)
  { return d[i][0] * d[j][1] - d[j][0] * d[i][1]; };
  const double ab = minor(0, 1), bc = minor(1, 2), cd = minor(2, 3), da = minor(3, 0),
               ac = minor(0, 2), bd = minor(1, 3);
  const double az = d[0][2], bz = d[1][2], cz = d[2][2], dz = d[3][2];
  const auto sum3 = [](auto a, auto b, auto c) { return a + b + c; };
  const double abc = sum3(az * bc, -bz * ac, cz * ab), bcd = sum3(bz * cd, -cz * bd, dz * bc),
               cda = sum3(cz * da, dz * ac, az * cd), dab = sum3(dz * ab, az * bd, bz * da);
  const double value = (lift[2] * dab - lift[3] * abc) + (lift[0] * bcd - lift[1] * cda);
  const auto size = [](double z1, double m1, double z2, double m2, double z3, double m3)
  { return std::abs(z1 * m1) + std::abs(z2 * m2) + std::abs(z3 * m3); };
  const double error = 4e-15 *
    (lift[3] * size(az, bc, bz, ac, cz, ab) + lift[0] * size(bz, cd, cz, bd, dz, bc) +
      lift[1] * size(cz, da, dz, ac, az, cd) + lift[2] * size(dz, ab, az, bd, bz, da));
  if (std::abs(value) > error)
  {
    return value > 0. ? 1 : -1;
  }
  const auto wide = [](double x) { return Wide(std::int64_t(x)); };
  const Wide wabc = sum3(wide(az) * wide(bc), -wide(bz) * wide(ac), wide(cz) * wide(ab)),
             wbcd = sum3(wide(bz) * wide(cd), -wide(cz) * wide(bd), wide(dz) * wide(bc)),
             wcda = sum3(wide(cz) * wide(da), wide(dz) * wide(ac), wide(az) * wide(cd)),
             wdab = sum3(wide(dz) * wide(ab), wide(az) * wide(bd), wide(bz) * wide(da));
  return signOf(
    (wide(lift[2]) * wdab - wide(lift[3]) * wabc) + (wide(lift[0]) * wbcd - wide(lift[1]) * wcda));
}

/// The first tetrahedron, with what is outside of it. False if there is none.
bool Delaunay::begin(std::span<const std::uint32_t> order)
{
  std::array<std::int32_t, 4> first{};
  std::size_t found = 0;
  for (const std::uint32_t index : order)
  {
    const auto point = std::int32_t(index);
    const auto& at = points_[index];
    const auto differs = [&](std::size_t i) { return at != points_[std::size_t(first[i])]; };
    const auto isOffLine = [&]
    {
      const GridPoint &o = points_[std::size_t(first[0])], &p = points_[std::size_t(first[1])];
      const std::int64_t ux = p.x - o.x, uy = p.y - o.y, uz = p.z - o.z;
      const std::int64_t vx = at.x - o.x, vy = at.y - o.y, vz = at.z - o.z;
      return uy * vz != uz * vy || uz * vx != ux * vz || ux * vy != uy * vx;
    };
    const bool isTaken = found == 0 || (found == 1 && differs(0)) || (found == 2 && isOffLine()) ||
      (found == 3 && orientation(first[0], first[1], first[2], point) != 0);
    if (isTaken)
    {
      first[found++] = point;
    }
    if (found == 4)
    {
      break;
    }
  }
  if (found < 4)
  {
    return false;
  }
  if (orientation(first[0], first[1], first[2], first[3]) < 0)
  {
    std::swap(first[0], first[1]);
  }
  cells_.push_back({ first, { 1, 2, 3, 4 } });
  for (int i = 0; i < 4; ++i)
  {
    const auto [a, b, c] = facet(cells_[0], i);
    // Seen from outside.
    cells_.push_back({ { a, c, b, Outside }, { 0, 0, 0, 0 } });
  }
  for (std::size_t i = 1; i < 5; ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      // Opposite to a vertex is the outer cell that lacks it.
      cells_[i].neighbors[k] = 1 + std::int32_t(cells_[0].indexOf(cells_[i].vertices[k]));
    }
    cells_[i].neighbors[3] = 0;
  }
  marks_.assign(cells_.size(), 0);
  joints_.resize(64);
  return true;
}

bool Delaunay::isInConflict(std::int32_t index, std::int32_t point) const
{
  const Cell& cell = cells_[std::size_t(index)];
  const int outside = cell.indexOf(Outside);
  if (outside == 4)
  {
    return inSphere(cell, point) > 0;
  }
  const auto [a, b, c] = facet(cell, outside);
  const int side = orientation(a, b, c, point);
  return side > 0 ||
    (side == 0 && inSphere(cells_[std::size_t(cell.neighbors[std::size_t(outside)])], point) > 0);
}

/// Walks to the cell in which the point lies, or one outside that sees it.
std::int32_t Delaunay::locate(std::int32_t point) const
{
  std::int32_t index = last_;
  std::int32_t from = -1;
  for (std::size_t step = 0; step < cells_.size(); ++step)
  {
    const Cell& cell = cells_[std::size_t(index)];
    if (cell.isOutside())
    {
      if (step > 0)
      {
        return index;
      }
      from = index;
      index = cell.neighbors[std::size_t(cell.indexOf(Outside))];
      continue;
    }
    std::int32_t next = -1;
    for (int i = 0; i < 4 && next < 0; ++i)
    {
      // Which one is tried first changes, so that no walk goes round in circles.
      const int side = (i + int(step)) & 3;
      if (cell.neighbors[std::size_t(side)] != from)
      {
        const auto [a, b, c] = facet(cell, side);
        next = orientation(a, b, c, point) < 0 ? cell.neighbors[std::size_t(side)] : -1;
      }
    }
    if (next < 0)
    {
      // Entered from where it was taken to be behind: from outside, where it began.
      const bool isBack = step == 1 && from >= 0 && cells_[std::size_t(from)].isOutside() &&
        isInConflict(from, point);
      return isBack ? from : index;
    }
    from = index;
    index = next;
  }
  return index;
}

/// Whether a facet of the rim, of a cell in the hole, is seen from the point with its inner side.
bool Delaunay::isVisible(const Facet& rim, std::int32_t point) const
{
  const auto [a, b, c] = facet(cells_[std::size_t(rim.cell)], int(rim.index));
  return a == Outside || b == Outside || c == Outside || orientation(a, b, c, point) > 0;
}

/// The cells whose spheres hold the point, and the facets around them. False if it is no use to go on.
bool Delaunay::findHole(std::int32_t point, std::int32_t first)
{
  ++round_;
  hole_.assign(1, first);
  marks_[std::size_t(first)] = round_;
  for (int widening = 0; widening < MostWidenings; ++widening)
  {
    rim_.clear();
    for (std::size_t i = 0; i < hole_.size(); ++i)
    {
      const Cell& cell = cells_[std::size_t(hole_[i])];
      for (std::size_t k = 0; k < 4; ++k)
      {
        const std::int32_t neighbor = cell.neighbors[k];
        if (marks_[std::size_t(neighbor)] != round_ && isInConflict(neighbor, point))
        {
          marks_[std::size_t(neighbor)] = round_;
          hole_.push_back(neighbor);
        }
      }
    }
    for (const std::int32_t index : hole_)
    {
      for (std::int32_t k = 0; k < 4; ++k)
      {
        if (marks_[std::size_t(cells_[std::size_t(index)].neighbors[std::size_t(k)])] != round_)
        {
          rim_.push_back({ index, k });
        }
      }
    }
    bool isSeen = true;
    for (const Facet& rim : rim_)
    {
      if (!isVisible(rim, point))
      {
        // In one plane with the point: what is behind belongs to the hole.
        isSeen = false;
        const std::int32_t behind = cells_[std::size_t(rim.cell)].neighbors[std::size_t(rim.index)];
        if (marks_[std::size_t(behind)] != round_)
        {
          marks_[std::size_t(behind)] = round_;
          hole_.push_back(behind);
        }
      }
    }
    if (isSeen)
    {
      return true;
    }
  }
  return false;
}

std::int32_t Delaunay::newCell()
{
  if (!unused_.empty())
  {
    const std::int32_t index = unused_.back();
    unused_.pop_back();
    return index;
  }
  cells_.emplace_back();
  marks_.push_back(0);
  return std::int32_t(cells_.size() - 1);
}

/// Two new facets meet at each edge of the rim: the second one finds the first.
void Delaunay::joinAlong(std::int32_t from, std::int32_t to, Facet own)
{
  const auto [low, high] = std::minmax(from, to);
  const std::uint64_t edge = std::uint64_t(std::uint32_t(low + 1)) << 32 | std::uint32_t(high + 1);
  const std::size_t mask = joints_.size() - 1;
  for (std::size_t at = std::size_t(edge * 0x9e3779b97f4a7c15u >> 32) & mask;; at = (at + 1) & mask)
  {
    Joint& joint = joints_[at];
    if (joint.round != round_)
    {
      joint = { edge, round_, own };
      return;
    }
    if (joint.edge == edge)
    {
      cells_[std::size_t(own.cell)].neighbors[std::size_t(own.index)] = joint.facet.cell;
      cells_[std::size_t(joint.facet.cell)].neighbors[std::size_t(joint.facet.index)] = own.cell;
      return;
    }
  }
}

void Delaunay::fillHole(std::int32_t point)
{
  while (joints_.size() < 4 * rim_.size())
  {
    joints_.assign(2 * joints_.size(), {});
  }
  for (const Facet& rim : rim_)
  {
    const auto [a, b, c] = facet(cells_[std::size_t(rim.cell)], int(rim.index));
    const std::int32_t behind = cells_[std::size_t(rim.cell)].neighbors[std::size_t(rim.index)];
    const std::int32_t index = newCell();
    cells_[std::size_t(index)] = { { a, b, c, point }, { -1, -1, -1, behind } };
    Cell& other = cells_[std::size_t(behind)];
    other.neighbors[std::size_t(other.indexOfNeighbor(rim.cell))] = index;
    joinAlong(b, c, { index, 0 });
    joinAlong(a, c, { index, 1 });
    joinAlong(a, b, { index, 2 });
    if (a != Outside && b != Outside && c != Outside)
    {
      last_ = index;
    }
  }
  for (const std::int32_t index : hole_)
  {
    marks_[std::size_t(index)] = 0;
    cells_[std::size_t(index)].vertices.fill(Outside);
    unused_.push_back(index);
  }
}

void Delaunay::insert(std::int32_t point)
{
  const std::int32_t first = locate(point);
  // On one place with an earlier point: within no sphere.
  if (isInConflict(first, point) && findHole(point, first))
  {
    fillHole(point);
  }
}

void Delaunay::dropUnused()
{
  std::vector<std::int32_t> indices(cells_.size(), -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < cells_.size(); ++i)
  {
    if (cells_[i].vertices[0] != Outside || cells_[i].vertices[1] != Outside)
    {
      indices[i] = std::int32_t(kept);
      cells_[kept++] = cells_[i];
    }
  }
  cells_.resize(kept);
  for (Cell& cell : cells_)
  {
    for (std::int32_t& neighbor : cell.neighbors)
    {
      neighbor = indices[std::size_t(neighbor)];
    }
  }
  marks_.clear();
  unused_.clear();
}
}
