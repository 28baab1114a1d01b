// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleFans.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace neuralmesh
{
namespace
{
/// The side from a corner to the next one of its triangle, as the edge that it lies on.
struct TriangleSide
{
  VertexIndex low;
  VertexIndex high;
  TriangleFans::Corner corner;

  bool isSameEdge(const TriangleSide& other) const
  {
    return low == other.low && high == other.high;
  }
  friend bool operator<(const TriangleSide& a, const TriangleSide& b)
  {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  }
};

TriangleFans::Corner nextInTriangle(TriangleFans::Corner corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

TriangleFans::Corner previousInTriangle(TriangleFans::Corner corner)
{
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

std::string text(const TriangleSide& side)
{
  return "edge " + std::to_string(side.low) + "-" + std::to_string(side.high);
}

std::string text(const std::array<std::uint32_t, 3>& triangle)
{
  return "triangle " + std::to_string(triangle[0]) + "-" + std::to_string(triangle[1]) + "-" +
    std::to_string(triangle[2]);
}
}

TriangleFans::TriangleFans(const TriangleMesh& mesh)
  : mesh_(mesh)
  , opposite_(3 * mesh.triangles.size(), NoCorner)
  , first_(mesh.points.size(), NoCorner)
  , valences_(mesh.points.size(), 0)
{
  requireDistinctCorners();
  linkSides();
  findFans();
}

void TriangleFans::requireDistinctCorners() const
{
  for (const auto& triangle : mesh_.triangles)
  {
    const auto& [a, b, c] = triangle;
    if (a == b || b == c || c == a)
    {
      throw std::runtime_error(text(triangle) + " uses a point twice");
    }
  }
}

void TriangleFans::linkSides()
{
  std::vector<TriangleSide> sides;
  sides.reserve(opposite_.size());
  for (Corner corner = 0; corner < opposite_.size(); ++corner)
  {
    const VertexIndex from = pointAt(corner), to = pointAt(nextInTriangle(corner));
    sides.push_back({ std::min(from, to), std::max(from, to), corner });
  }
  std::sort(sides.begin(), sides.end());
  for (auto first = sides.begin(); first != sides.end();)
  {
    const auto last = std::find_if(
      first, sides.end(), [&](const TriangleSide& side) { return !side.isSameEdge(*first); });
    const auto count = last - first;
    if (count > 2)
    {
      throw std::runtime_error(text(*first) + " has " + std::to_string(count) + " triangles");
    }
    if (count == 2)
    {
      const Corner one = first->corner, other = (last - 1)->corner;
      if (pointAt(previousInTriangle(one)) == pointAt(previousInTriangle(other)))
      {
        throw std::runtime_error(text(mesh_.triangles[one / 3]) + " is there twice");
      }
      if (pointAt(one) == pointAt(other))
      {
        throw std::runtime_error("the two triangles at " + text(*first) +
          " are not oriented alike: both run along it in the same direction");
      }
      opposite_[one] = other;
      opposite_[other] = one;
    }
    first = last;
  }
}

void TriangleFans::findFans()
{
  std::vector<Corner> cornersAt(valences_.size(), 0);
  for (Corner corner = 0; corner < opposite_.size(); ++corner)
  {
    const VertexIndex point = pointAt(corner);
    ++cornersAt[point];
    const bool isAtBoundary = opposite_[corner] == NoCorner;
    if (first_[point] == NoCorner || isAtBoundary)
    {
      first_[point] = corner;
    }
  }
  for (VertexIndex point = 0; point < first_.size(); ++point)
  {
    if (first_[point] != NoCorner)
    {
      const Fan fan = at(point);
      if (fan.corners.size() != cornersAt[point])
      {
        throw std::runtime_error("the triangles at point " + std::to_string(point) +
          " are not one fan: parts of the surface meet in that point alone");
      }
      valences_[point] = unsigned(fan.neighbors.size());
    }
  }
}

TriangleFans::Fan TriangleFans::at(VertexIndex point) const
{
  Fan fan;
  const Corner first = first_[point];
  Corner corner = first;
  do
  {
    fan.corners.push_back(corner);
    fan.neighbors.push_back(pointAt(nextInTriangle(corner)));
    corner = after(corner);
  } while (corner != NoCorner && corner != first);
  fan.isOpen = corner == NoCorner;
  if (fan.isOpen)
  {
    fan.neighbors.push_back(pointAt(previousInTriangle(fan.corners.back())));
  }
  return fan;
}

TriangleFans::Corner TriangleFans::after(Corner corner) const
{
  return opposite_[previousInTriangle(corner)];
}
}
