// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleFans.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>

namespace neuralmesh
{
namespace
{
/// The side from a corner to the next one of its triangle, as the edge that it lies on.
struct Side
{
  VertexIndex low;
  VertexIndex high;
  TriangleFans::Corner corner;

  bool isSameEdge(const Side& other) const
  {
    return this->low == other.low && this->high == other.high;
  }
  friend bool operator<(const Side& a, const Side& b)
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

std::string text(const Side& side)
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
  this->requireDistinctCorners();
  this->linkSides();
  this->findFans();
}

void TriangleFans::requireDistinctCorners() const
{
  for (const auto& triangle : this->mesh_.triangles)
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
  std::vector<Side> sides;
  sides.reserve(this->opposite_.size());
  for (Corner corner = 0; corner < this->opposite_.size(); ++corner)
  {
    const VertexIndex from = this->pointAt(corner), to = this->pointAt(nextInTriangle(corner));
    sides.push_back({ std::min(from, to), std::max(from, to), corner });
  }
  std::sort(sides.begin(), sides.end());
  for (auto first = sides.begin(); first != sides.end();)
  {
    const auto last =
      std::find_if(first, sides.end(), [&](const Side& side) { return !side.isSameEdge(*first); });
    const auto count = last - first;
    if (count > 2)
    {
      throw std::runtime_error(text(*first) + " has " + std::to_string(count) + " triangles");
    }
    if (count == 2)
    {
      const Corner one = first->corner, other = (last - 1)->corner;
      if (this->pointAt(previousInTriangle(one)) == this->pointAt(previousInTriangle(other)))
      {
        throw std::runtime_error(text(this->mesh_.triangles[one / 3]) + " is there twice");
      }
      if (this->pointAt(one) == this->pointAt(other))
      {
        throw std::runtime_error("the two triangles at " + text(*first) +
          " are not oriented alike: both run along it in the same direction");
      }
      this->opposite_[one] = other;
      this->opposite_[other] = one;
    }
    first = last;
  }
}

void TriangleFans::findFans()
{
  std::vector<Corner> cornersAt(this->valences_.size(), 0);
  for (Corner corner = 0; corner < this->opposite_.size(); ++corner)
  {
    const VertexIndex point = this->pointAt(corner);
    ++cornersAt[point];
    const bool isAtBoundary = this->opposite_[corner] == NoCorner;
    if (this->first_[point] == NoCorner || isAtBoundary)
    {
      this->first_[point] = corner;
    }
  }
  for (VertexIndex point = 0; point < this->first_.size(); ++point)
  {
    if (this->first_[point] != NoCorner)
    {
      const Fan fan = this->at(point);
      if (fan.corners.size() != cornersAt[point])
      {
        throw std::runtime_error("the triangles at point " + std::to_string(point) +
          " are not one fan: parts of the surface meet in that point alone");
      }
      this->valences_[point] = unsigned(fan.neighbors.size());
    }
  }
}

TriangleFans::Fan TriangleFans::at(VertexIndex point) const
{
  Fan fan;
  const Corner first = this->first_[point];
  Corner corner = first;
  do
  {
    fan.corners.push_back(corner);
    fan.neighbors.push_back(this->pointAt(nextInTriangle(corner)));
    corner = this->after(corner);
  } while (corner != NoCorner && corner != first);
  fan.isOpen = corner == NoCorner;
  if (fan.isOpen)
  {
    fan.neighbors.push_back(this->pointAt(previousInTriangle(fan.corners.back())));
  }
  return fan;
}

TriangleFans::Corner TriangleFans::after(Corner corner) const
{
  return this->opposite_[previousInTriangle(corner)];
}
}
