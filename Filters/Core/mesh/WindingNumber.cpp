// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/WindingNumber.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace neuralmesh
{
namespace
{
constexpr std::uint32_t MostInLeaf = 8;
/// A node that is farther off than so many of its radii counts as one.
constexpr double FarRadii = 3.;
}

WindingNumber::WindingNumber(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles)
  : mesh_(mesh)
{
  items_.reserve(triangles.size());
  for (const std::uint32_t triangle : triangles)
  {
    items_.push_back({ centroid(triangle), triangle });
  }
  if (!items_.empty())
  {
    build(0, std::uint32_t(items_.size()));
  }
}

Eigen::Vector3d WindingNumber::centroid(std::uint32_t triangle) const
{
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return (mesh_.points[a] + mesh_.points[b] + mesh_.points[c]) / 3.;
}

Eigen::Vector3d WindingNumber::areaVector(std::uint32_t triangle) const
{
  const auto& [a, b, c] = mesh_.triangles[triangle];
  return 0.5 * (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
}

double WindingNumber::solidAngle(std::uint32_t triangle, const Eigen::Vector3d& place) const
{
  const auto& corners = mesh_.triangles[triangle];
  const Eigen::Vector3d a = mesh_.points[corners[0]] - place, b = mesh_.points[corners[1]] - place,
                        c = mesh_.points[corners[2]] - place;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2. *
    std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

void WindingNumber::build(std::uint32_t begin, std::uint32_t end)
{
  const auto index = std::uint32_t(nodes_.size());
  nodes_.emplace_back();
  Node node;
  node.begin = begin;
  node.end = end;
  Eigen::Vector3d low = items_[begin].centroid, high = low;
  double area = 0.;
  for (std::uint32_t i = begin; i < end; ++i)
  {
    const Eigen::Vector3d at = items_[i].centroid, vector = areaVector(items_[i].triangle);
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
    node.area += vector;
    node.center += vector.norm() * at;
    area += vector.norm();
  }
  node.center =
    area > 0. ? Eigen::Vector3d(node.center / area) : Eigen::Vector3d((low + high) / 2.);
  for (std::uint32_t i = begin; i < end; ++i)
  {
    for (const std::uint32_t corner : mesh_.triangles[items_[i].triangle])
    {
      node.radius = std::max(node.radius, (mesh_.points[corner] - node.center).norm());
    }
  }
  if (end - begin > MostInLeaf)
  {
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
      [axis](const Item& a, const Item& b)
      {
        return a.centroid[axis] != b.centroid[axis] ? a.centroid[axis] < b.centroid[axis]
                                                    : a.triangle < b.triangle;
      });
    build(begin, middle);
    build(middle, end);
  }
  node.next = std::uint32_t(nodes_.size());
  nodes_[index] = node;
}

double WindingNumber::atTriangle(std::uint32_t triangle) const
{
  const Eigen::Vector3d place = centroid(triangle);
  double angle = 0.;
  for (std::uint32_t index = 0; index < nodes_.size();)
  {
    const Node& node = nodes_[index];
    const bool isLeaf = node.next == index + 1;
    const Eigen::Vector3d away = node.center - place;
    const double distance = away.norm();
    if (distance > FarRadii * node.radius)
    {
      angle += node.area.dot(away) / (distance * distance * distance);
      index = node.next;
      continue;
    }
    for (std::uint32_t i = node.begin; isLeaf && i < node.end; ++i)
    {
      const std::uint32_t other = items_[i].triangle;
      angle += other == triangle ? 0. : solidAngle(other, place);
    }
    ++index;
  }
  return angle / (4. * std::numbers::pi);
}
}
