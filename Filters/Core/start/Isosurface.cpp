// SPDX-License-Identifier: BSD-3-Clause
#include "start/Isosurface.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
// A cube has voxels at its corners. Bit k of the number of a corner tells that it is on the high side along
// axis k. A case tells by its bits which of the corners are above the level.

constexpr unsigned CubeCorners = 8;
constexpr unsigned CountOfCases = 1u << CubeCorners;
constexpr unsigned CubeEdges = 12;
constexpr unsigned LongestPolygon = 7;
/// No case needs more.
constexpr unsigned MostTriangles = 5;

struct CubeEdge
{
  unsigned axis;
  unsigned low; ///< the corner where it begins
};

/// Four along each axis.
constexpr CubeEdge edge(unsigned index)
{
  const unsigned axis = index / 4, u = (axis + 1) % 3, v = (axis + 2) % 3;
  return { axis, (index & 1u) << u | (index >> 1 & 1u) << v };
}

constexpr unsigned edgeBetween(unsigned corner, unsigned other)
{
  unsigned index = 0;
  while ((edge(index).low | 1u << edge(index).axis) != (corner | other) ||
    edge(index).low != (corner & other))
  {
    ++index;
  }
  return index;
}

/// The corners of a side of the cube, counter-clockwise as seen from outside.
constexpr std::array<unsigned, 4> side(unsigned axis, bool isHigh)
{
  const unsigned first = isHigh ? 1u << axis : 0u;
  const unsigned u = first | 1u << (axis + 1) % 3, v = first | 1u << (axis + 2) % 3;
  return isHigh ? std::array{ first, u, u | v, v } : std::array{ first, v, u | v, u };
}

/// Whether two edges are of one side of the cube.
constexpr bool shareSide(const CubeEdge& a, const CubeEdge& b)
{
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    if (axis != a.axis && axis != b.axis && ((a.low ^ b.low) >> axis & 1u) == 0)
    {
      return true;
    }
  }
  return false;
}

/// Between their middles, in halves of a side.
constexpr unsigned squaredDistance(const CubeEdge& a, const CubeEdge& b)
{
  unsigned sum = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const auto place = [axis](const CubeEdge& e)
    { return axis == e.axis ? 1 : 2 * int(e.low >> axis & 1u); };
    sum += unsigned((place(a) - place(b)) * (place(a) - place(b)));
  }
  return sum;
}

/// The triangles of a case, by the edges that their corners lie on.
struct CubeCase
{
  std::array<std::array<std::uint8_t, 3>, MostTriangles> triangles{};
  unsigned count = 0;
};

/// Cuts a polygon into triangles. Diagonals are as short as they can be, all together, and none lies in a
/// side of the cube: the cube beyond might have it, too.
class PolygonCut
{
public:
  constexpr PolygonCut(const std::array<unsigned, LongestPolygon>& polygon, unsigned size)
    : polygon_(polygon)
  {
    for (unsigned length = 2; length < size; ++length)
    {
      for (unsigned first = 0; first + length < size; ++first)
      {
        findApex(first, first + length);
      }
    }
    last_ = size - 1;
  }

  constexpr void addTo(CubeCase& result) const { add(0, last_, result); }

private:
  static constexpr unsigned Never = 1000;

  /// The best triangle on a diagonal, on the side of the corners between its ends.
  constexpr void findApex(unsigned first, unsigned last)
  {
    costs_[first][last] = ~0u;
    for (unsigned apex = first + 1; apex < last; ++apex)
    {
      const unsigned cost =
        costs_[first][apex] + diagonal(first, apex) + costs_[apex][last] + diagonal(apex, last);
      if (cost < costs_[first][last])
      {
        costs_[first][last] = cost;
        apexes_[first][last] = apex;
      }
    }
  }

  constexpr unsigned diagonal(unsigned first, unsigned last) const
  {
    const CubeEdge a = edge(polygon_[first]), b = edge(polygon_[last]);
    return last - first == 1 ? 0 : shareSide(a, b) ? Never : squaredDistance(a, b);
  }

  constexpr void add(unsigned first, unsigned last, CubeCase& result) const
  {
    if (last - first > 1)
    {
      const unsigned apex = apexes_[first][last];
      result.triangles[result.count++] = { std::uint8_t(polygon_[first]),
        std::uint8_t(polygon_[apex]), std::uint8_t(polygon_[last]) };
      add(first, apex, result);
      add(apex, last, result);
    }
  }

  std::array<unsigned, LongestPolygon> polygon_;
  std::array<std::array<unsigned, LongestPolygon>, LongestPolygon> costs_{};
  std::array<std::array<unsigned, LongestPolygon>, LongestPolygon> apexes_{};
  unsigned last_ = 0;
};

/// In each side of the cube, a line cuts off each run of corners that are above the level: from where the
/// run is entered, counter-clockwise as seen from outside, to where it is left. The cube beyond the side has
/// the same line the other way. Lines make polygons; these bound what is above.
constexpr CubeCase caseOf(unsigned above)
{
  const auto isAbove = [above](unsigned corner) { return (above >> corner & 1u) != 0; };
  std::array<unsigned, CubeEdges> next{};
  std::array<bool, CubeEdges> isOpen{};
  for (unsigned i = 0; i < 6; ++i)
  {
    const auto corners = side(i / 2, i % 2 != 0);
    for (unsigned k = 0; k < 4; ++k)
    {
      const unsigned before = corners[(k + 3) % 4];
      if (!isAbove(before) && isAbove(corners[k]))
      {
        unsigned last = k;
        while (isAbove(corners[(last + 1) % 4]))
        {
          ++last;
        }
        const unsigned entered = edgeBetween(before, corners[k]);
        next[entered] = edgeBetween(corners[last % 4], corners[(last + 1) % 4]);
        isOpen[entered] = true;
      }
    }
  }
  CubeCase result;
  for (unsigned first = 0; first < CubeEdges; ++first)
  {
    std::array<unsigned, LongestPolygon> polygon{};
    unsigned size = 0;
    for (unsigned at = first; isOpen[at]; at = next[at])
    {
      isOpen[at] = false;
      polygon[size++] = at;
    }
    if (size > 0)
    {
      PolygonCut(polygon, size).addTo(result);
    }
  }
  return result;
}

constexpr auto CubeCases = []
{
  std::array<CubeCase, CountOfCases> cases{};
  for (unsigned above = 0; above < CountOfCases; ++above)
  {
    cases[above] = caseOf(above);
  }
  return cases;
}();

class IsosurfaceMaker
{
public:
  IsosurfaceMaker(const VoxelGrid& grid, std::span<const float> values, float level)
    : grid_(grid)
    , values_(values)
    , level_(level)
    , strides_(grid.strides())
    , points_(3 * grid.size())
  {
  }

  TriangleMesh make()
  {
    forEachVoxel(grid_,
      [this](std::size_t index, std::size_t x, std::size_t y, std::size_t z) {
        addPoints(index, { x, y, z });
      });
    forEachVoxel(grid_,
      [this](std::size_t index, std::size_t x, std::size_t y, std::size_t z)
      {
        if (x + 1 < grid_.counts[0] && y + 1 < grid_.counts[1] && z + 1 < grid_.counts[2])
        {
          addTriangles(index);
        }
      });
    return std::move(mesh_);
  }

private:
  bool isAbove(std::size_t voxel) const { return values_[voxel] > level_; }

  std::size_t cornerAt(std::size_t voxel, unsigned corner) const
  {
    return voxel + (corner & 1u) * strides_[0] + (corner >> 1 & 1u) * strides_[1] +
      (corner >> 2 & 1u) * strides_[2];
  }

  /// Between a voxel and the next ones.
  void addPoints(std::size_t voxel, const std::array<std::size_t, 3>& place)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (place[axis] + 1 < grid_.counts[axis] && isAbove(voxel) != isAbove(voxel + strides_[axis]))
      {
        const double low = values_[voxel], high = values_[voxel + strides_[axis]];
        Eigen::Vector3d point = grid_.center(place[0], place[1], place[2]);
        point[Eigen::Index(axis)] += grid_.width * ((double(level_) - low) / (high - low));
        points_[3 * voxel + axis] = std::uint32_t(mesh_.points.size());
        mesh_.points.push_back(point);
      }
    }
  }

  /// In the cube that begins at a voxel.
  void addTriangles(std::size_t voxel)
  {
    unsigned above = 0;
    for (unsigned corner = 0; corner < CubeCorners; ++corner)
    {
      above |= isAbove(cornerAt(voxel, corner)) ? 1u << corner : 0u;
    }
    const CubeCase& cube = CubeCases[above];
    for (unsigned i = 0; i < cube.count; ++i)
    {
      auto& triangle = mesh_.triangles.emplace_back();
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        const CubeEdge at = edge(cube.triangles[i][corner]);
        triangle[corner] = points_[3 * cornerAt(voxel, at.low) + at.axis];
      }
    }
  }

  const VoxelGrid& grid_;
  std::span<const float> values_;
  float level_;
  std::array<std::size_t, 3> strides_;
  std::vector<std::uint32_t>
    points_; ///< three to a voxel, between it and the next one along each axis
  TriangleMesh mesh_;
};
}

TriangleMesh isosurface(const VoxelGrid& grid, std::span<const float> values, float level)
{
  return IsosurfaceMaker(grid, values, level).make();
}
}
