// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The Delaunay tetrahedra of points: no point lies within the sphere of a tetrahedron. By insertion
/// of one point after another (Bowyer 1981, Watson 1981) with exact arithmetic. For that, points are
/// rounded to a grid of 4 million cells along the longest side of their box, and shifted on it by a
/// few cells by chance, so that there are hardly four on one circle. A point that is rounded to the
/// same place as an earlier one is left out. About O(n log n) for n points of a surface.
class Delaunay
{
public:
  /// Stands for what is outside the convex hull: the fourth vertex of a cell on the other side of
  /// each triangle of the hull.
  static constexpr std::int32_t Outside = -1;

  struct Cell
  {
    std::array<std::int32_t, 4> vertices;  ///< indices of points, or Outside
    std::array<std::int32_t, 4> neighbors; ///< across the facet opposite to each vertex

    bool isOutside() const { return indexOf(Outside) < 4; }
    /// The place of a vertex in the cell; 4 if it is none.
    int indexOf(std::int32_t vertex) const
    {
      return vertices[0] == vertex ? 0
        : vertices[1] == vertex    ? 1
        : vertices[2] == vertex    ? 2
        : vertices[3] == vertex    ? 3
                                   : 4;
    }
    int indexOfNeighbor(std::int32_t cell) const
    {
      return neighbors[0] == cell ? 0 : neighbors[1] == cell ? 1 : neighbors[2] == cell ? 2 : 3;
    }
  };

  explicit Delaunay(std::span<const Vector4> points);

  /// Where a point lies on the grid, and how long a cell of the grid is. With other places than these cells
  /// that are nearly flat look inside out.
  Eigen::Vector3d onGrid(std::int32_t point) const
  {
    const GridPoint& p = points_[std::size_t(point)];
    return { double(p.x), double(p.y), double(p.z) };
  }
  double gridWidth() const { return gridWidth_; }

  /// Those inside and outside of the hull; none if all points lie in a plane.
  const std::vector<Cell>& cells() const { return cells_; }
  /// Of a cell, the vertices of the facet opposite to the one at `index`: counter-clockwise, seen from
  /// that one.
  static std::array<std::int32_t, 3> facet(const Cell& cell, int index)
  {
    constexpr std::array<std::array<int, 3>, 4> Facets{ { { 1, 3, 2 }, { 0, 2, 3 }, { 0, 3, 1 },
      { 0, 1, 2 } } };
    const auto& [a, b, c] = Facets[std::size_t(index)];
    return { cell.vertices[std::size_t(a)], cell.vertices[std::size_t(b)],
      cell.vertices[std::size_t(c)] };
  }

private:
  struct GridPoint
  {
    std::int32_t x, y, z;
    auto operator<=>(const GridPoint&) const = default;
  };
  struct Facet
  {
    std::int32_t cell;
    std::int32_t index;
  };
  /// An edge of the hole that a new point makes, and the new facet at it.
  struct Joint
  {
    std::uint64_t edge = 0;
    std::uint32_t round = 0;
    Facet facet{};
  };

  bool begin(std::span<const std::uint32_t> order);
  void insert(std::int32_t point);
  std::int32_t locate(std::int32_t point) const;
  bool isInConflict(std::int32_t cell, std::int32_t point) const;
  bool findHole(std::int32_t point, std::int32_t first);
  bool isVisible(const Facet& facet, std::int32_t point) const;
  void fillHole(std::int32_t point);
  void joinAlong(std::int32_t from, std::int32_t to, Facet facet);
  std::int32_t newCell();
  void dropUnused();

  int orientation(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const;
  int inSphere(const Cell& cell, std::int32_t point) const;

  std::vector<GridPoint> points_;
  double gridWidth_ = 0.;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> marks_; ///< of the cells: round_ if they are in the hole
  std::vector<std::int32_t> unused_;
  std::uint32_t round_ = 0;
  std::int32_t last_ = 0;
  std::vector<std::int32_t> hole_;
  std::vector<Facet> rim_;
  std::vector<Joint> joints_;
};
}
