// SPDX-License-Identifier: BSD-3-Clause
#include "start/OneSheet.h"

#include "base/UnitVector.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/Pieces.h"
#include "mesh/SmallPieces.h"
#include "start/VoxelNeighbors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>
#include <vector>

namespace neuralmesh
{
namespace
{
/// In thicknesses: the width of cells, 27 of which tell the plane of the sheet,
constexpr float PlaneCell = 1.3f;
/// how far behind a vertex those of the other side are at most,
constexpr float OtherSideDepth = 2.f;
/// and how far aside.
constexpr float OtherSideWidth = 1.f;
/// Of the ball with those at most, about the middle of that depth.
const float OtherSideReach = std::hypot(0.5f * OtherSideDepth, OtherSideWidth);
/// The cosine between the normals of both sides, at most.
constexpr float OtherSideCosine = -0.4f;
/// Holes are filled up to edges of so many thicknesses.
constexpr double LongestFilledEdge = 3.;

/// Of points in a cell.
struct Moments
{
  double count = 0.;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Eigen::Vector3d& point)
  {
    count += 1.;
    sum += point;
    squares += point * point.transpose();
  }
  Moments& operator+=(const Moments& other)
  {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
    return *this;
  }
  Eigen::Matrix3d covariance() const { return squares - sum * sum.transpose() / count; }
};

/// Points by the voxels that they lie in.
class PointsInVoxels
{
public:
  PointsInVoxels(std::span<const Vector4> points, double width)
  {
    Eigen::AlignedBox3d box;
    for (const Vector4 point : points)
    {
      box.extend(point.toDouble());
    }
    // With layers around, so that all have neighbours.
    grid_.width = width;
    grid_.first = box.min().array() - 2. * width;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      grid_.counts[std::size_t(axis)] = std::size_t(box.sizes()[axis] / width) + 6;
    }
    std::vector<std::size_t> voxels;
    voxels.reserve(points.size());
    ends_.assign(grid_.size() + 1, 0);
    for (const Vector4 point : points)
    {
      voxels.push_back(voxelAt(point));
      ++ends_[voxels.back() + 1];
    }
    std::partial_sum(ends_.begin(), ends_.end(), ends_.begin());
    numbers_.resize(points.size());
    std::vector<std::uint32_t> next(ends_.begin(), ends_.end() - 1);
    for (std::uint32_t i = 0; i < voxels.size(); ++i)
    {
      numbers_[next[voxels[i]]++] = i;
    }
  }

  const VoxelGrid& grid() const { return grid_; }
  std::size_t voxelAt(Vector4 point) const { return grid_.voxelAt(point.toDouble()); }
  /// The numbers of the points in a voxel.
  std::span<const std::uint32_t> in(std::size_t voxel) const
  {
    return { numbers_.data() + ends_[voxel], numbers_.data() + ends_[voxel + 1] };
  }
  /// Calls `use` for the numbers of the points in the voxel with a place, and in those around it.
  template <typename Use>
  void forEachAround(Vector4 place, Use use) const
  {
    const std::size_t voxel = voxelAt(place);
    if (voxel == grid_.size())
    {
      return;
    }
    const auto useAll = [&](std::size_t v) { std::ranges::for_each(in(v), use); };
    useAll(voxel);
    forEachNeighbor(grid_, voxel, useAll);
  }

private:
  VoxelGrid grid_;
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint32_t> numbers_;
};

std::vector<Vector4> normalsOf(const Mesh& mesh)
{
  std::vector<Vector4> normals(mesh.indexEnd());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 p = mesh.position(a);
      const Vector4 normal = cross(mesh.position(b) - p, mesh.position(c) - p);
      for (const VertexIndex v : { a, b, c })
      {
        normals[v] += normal;
      }
    });
  for (Vector4& normal : normals)
  {
    normal = unit(normal);
  }
  return normals;
}

class SheetFlood
{
public:
  SheetFlood(const Mesh& skin, float thickness)
    : skin_(skin)
    , thickness_(thickness)
    , normals_(normalsOf(skin))
    , voxels_(skin.positions(), OtherSideReach * thickness)
  {
    findSteepness();
  }

  /// The triangles that do not belong to the side that is kept.
  std::vector<Triangle> otherSide()
  {
    std::vector<VertexIndex> byFlatness(normals_.size());
    std::iota(byFlatness.begin(), byFlatness.end(), VertexIndex(0));
    std::sort(byFlatness.begin(), byFlatness.end(),
      [&](VertexIndex a, VertexIndex b)
      { return std::tie(steepness_[a], a) < std::tie(steepness_[b], b); });
    sides_.assign(normals_.size(), Side::Unknown);
    for (const VertexIndex seed : byFlatness)
    {
      if (sides_[seed] == Side::Unknown)
      {
        flood(seed);
      }
    }
    std::vector<Triangle> result;
    skin_.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        if (!isKept(a) || !isKept(b) || !isKept(c))
        {
          result.push_back({ a, b, c });
        }
      });
    return result;
  }

private:
  enum class Side : std::uint8_t
  {
    Unknown,
    Kept,
    Other
  };

  /// How far the skin at a vertex is from lying in the plane of the sheet around it: 0 on a flat side,
  /// 1 on its rim. Both sides together tell that plane.
  void findSteepness()
  {
    steepness_.resize(normals_.size());
    const PointsInVoxels cells(skin_.positions(), PlaneCell * thickness_);
    std::vector<Moments> moments(cells.grid().size());
    std::vector<std::size_t> filled;
    for (std::size_t cell = 0; cell < moments.size(); ++cell)
    {
      for (const VertexIndex v : cells.in(cell))
      {
        moments[cell].add(skin_.position(v).toDouble());
      }
      if (!cells.in(cell).empty())
      {
        filled.push_back(cell);
      }
    }
    for (const std::size_t cell : filled)
    {
      Moments sum = moments[cell];
      forEachNeighbor(cells.grid(), cell, [&](std::size_t neighbor) { sum += moments[neighbor]; });
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
      solver.computeDirect(sum.covariance());
      const Eigen::Vector3d across = solver.eigenvectors().col(0);
      for (const VertexIndex v : cells.in(cell))
      {
        steepness_[v] = float(1. - std::abs(across.dot(normals_[v].toDouble())));
      }
    }
  }

  void flood(VertexIndex seed)
  {
    using Entry = std::pair<float, VertexIndex>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.emplace(steepness_[seed], seed);
    while (!open.empty())
    {
      const VertexIndex v = open.top().second;
      open.pop();
      if (sides_[v] != Side::Unknown)
      {
        continue;
      }
      if (hasKeptSideBehind(v))
      {
        sides_[v] = Side::Other;
        continue;
      }
      sides_[v] = Side::Kept;
      markOtherSide(v);
      for (const VertexIndex next : skin_.ring(v))
      {
        if (sides_[next] == Side::Unknown)
        {
          open.emplace(steepness_[next], next);
        }
      }
    }
  }

  bool isKept(VertexIndex v) const { return sides_[v] == Side::Kept; }

  /// Whether a vertex turns its back on another one, as one side of the skin on the other side.
  bool isBackToBack(VertexIndex v, VertexIndex other) const
  {
    const Vector4 offset = skin_.position(other) - skin_.position(v);
    const float depth = -dot(offset, normals_[v]);
    const float aside = squaredNorm(offset) - depth * depth;
    const float width = OtherSideWidth * thickness_;
    return depth > 0.f && depth < OtherSideDepth * thickness_ && aside < width * width &&
      dot(normals_[other], normals_[v]) < OtherSideCosine;
  }

  /// About where those lie on which a vertex can turn its back.
  Vector4 placeBehind(VertexIndex v) const
  {
    return skin_.position(v) - 0.5f * OtherSideDepth * thickness_ * normals_[v];
  }

  void markOtherSide(VertexIndex v)
  {
    voxels_.forEachAround(placeBehind(v),
      [&](VertexIndex other)
      {
        if (sides_[other] == Side::Unknown && isBackToBack(v, other))
        {
          sides_[other] = Side::Other;
        }
      });
  }

  /// Around a bend the outer side is the larger one: the inner side's vertices see but a part of
  /// it behind them, while all of it has the inner side behind it.
  bool hasKeptSideBehind(VertexIndex v) const
  {
    bool result = false;
    voxels_.forEachAround(placeBehind(v),
      [&](VertexIndex other)
      { result = result || (sides_[other] == Side::Kept && isBackToBack(v, other)); });
    return result;
  }

  const Mesh& skin_;
  float thickness_;
  std::vector<Vector4> normals_;
  PointsInVoxels voxels_;
  std::vector<float> steepness_;
  std::vector<Side> sides_;
};

/// To which skin each vertex belongs.
std::vector<std::uint32_t> skinsOfVertices(const Mesh& mesh)
{
  std::vector<std::uint32_t> result(mesh.indexEnd());
  std::uint32_t number = 0;
  for (const Piece& skin : findPieces(mesh))
  {
    for (const VertexIndex v : skin.vertices)
    {
      result[v] = number;
    }
    ++number;
  }
  return result;
}

/// Where a sheet is folded as narrowly as its skin is thick, the flood does not get through, and a patch beyond it is
/// left over, of either side. Filled like a hole, it is shut, and shows no sheet. But if nothing else is left of a skin,
/// that is all there is of a small sheet.
void dropShutPatches(Mesh& sheets, const std::vector<std::uint32_t>& skinOf)
{
  const std::vector<Piece> patches = findPieces(sheets);
  const auto skin = [&](const Piece& patch) { return skinOf[patch.vertices.front()]; };
  std::vector<std::uint8_t> hasSheet(skinOf.size(), 0), isDropped(sheets.indexEnd(), 0);
  for (const Piece& patch : patches)
  {
    hasSheet[skin(patch)] = hasSheet[skin(patch)] != 0 || !patch.isClosed ? 1 : 0;
  }
  for (const Piece& patch : patches)
  {
    for (const VertexIndex v : patch.vertices)
    {
      isDropped[v] = patch.isClosed ? hasSheet[skin(patch)] : 0;
    }
  }
  std::vector<Triangle> triangles;
  sheets.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      if (isDropped[a] != 0)
      {
        triangles.push_back({ a, b, c });
      }
    });
  sheets.removeTriangles(triangles);
}
}

bool keepOneSheet(Mesh& skin, float thickness)
{
  const std::vector<std::uint32_t> skinOf = skinsOfVertices(skin);
  skin.removeTriangles(SheetFlood(skin, thickness).otherSide());
  skin.removeTriangles(findSmallPieces(skin));
  BoundaryManager boundaries(skin);
  fillBoundaries(skin, boundaries, LongestFilledEdge * double(thickness));
  dropShutPatches(skin, skinOf);
  skin.dropErased();
  return skin.vertexCount() > 3;
}
}
