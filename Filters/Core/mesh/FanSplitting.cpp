// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/FanSplitting.h"

#include "base/DisjointSets.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A corner of a triangle, with the two other points of it, ordered by where it is.
struct Corner
{
  std::uint32_t point;
  std::uint32_t triangle;
  std::uint32_t next;
  std::uint32_t last;
};
}

std::size_t splitFans(TriangleMesh& mesh)
{
  std::vector<std::uint32_t> firstAt(mesh.points.size() + 1, 0);
  for (const auto& triangle : mesh.triangles)
  {
    for (const std::uint32_t point : triangle)
    {
      ++firstAt[point + 1];
    }
  }
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    firstAt[point + 1] += firstAt[point];
  }
  std::vector<Corner> corners(3 * mesh.triangles.size());
  std::vector<std::uint32_t> filledAt(firstAt.begin(), firstAt.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const auto& triangle = mesh.triangles[t];
    for (std::size_t k = 0; k < 3; ++k)
    {
      corners[filledAt[triangle[k]]++] = { triangle[k], t, triangle[(k + 1) % 3],
        triangle[(k + 2) % 3] };
    }
  }
  const std::size_t before = mesh.points.size();
  for (std::size_t point = 0; point < before; ++point)
  {
    const Corner* const first = corners.data() + firstAt[point];
    const std::size_t count = firstAt[point + 1] - firstAt[point];
    DisjointSets fans(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      const Corner* const after = std::find_if(
        first, first + count, [&](const Corner& c) { return c.next == first[i].last; });
      if (after != first + count)
      {
        fans.join(std::size_t(after - first), i);
      }
    }
    // The fan of the first triangle keeps the point.
    std::vector<std::pair<std::size_t, std::uint32_t>> added;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t fan = fans.root(i);
      if (fan == fans.root(0))
      {
        continue;
      }
      auto own = std::find_if(
        added.begin(), added.end(), [&](const auto& other) { return other.first == fan; });
      if (own == added.end())
      {
        added.emplace_back(fan, std::uint32_t(mesh.points.size()));
        const Eigen::Vector3d place = mesh.points[point];
        mesh.points.push_back(place);
        own = added.end() - 1;
      }
      auto& triangle = mesh.triangles[first[i].triangle];
      *std::find(triangle.begin(), triangle.end(), std::uint32_t(point)) = own->second;
    }
  }
  return mesh.points.size() - before;
}
}
