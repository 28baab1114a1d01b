// SPDX-License-Identifier: BSD-3-Clause
#include "OneSheet.h"

#include "BoundaryFilling.h"
#include "NumberedTriangles.h"
#include "SmallPieces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace neuralmesh
{
namespace
{
/// In thicknesses: the width of cells, 27 of which tell the plane of the sheet,
constexpr float PlaneCell = 1.3f;
/// how far behind a triangle those of the other side are at most,
constexpr float OtherSideDepth = 2.f;
/// and how far aside.
constexpr float OtherSideWidth = 1.f;
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
    this->count += 1.;
    this->sum += point;
    this->squares += point * point.transpose();
  }
  Moments& operator+=(const Moments& other)
  {
    this->count += other.count;
    this->sum += other.sum;
    this->squares += other.squares;
    return *this;
  }
  Eigen::Matrix3d covariance() const
  {
    return this->squares - this->sum * this->sum.transpose() / this->count;
  }
};

class SheetFlood
{
public:
  SheetFlood(const Mesh& skin, float thickness)
    : skin_(skin)
    , thickness_(thickness)
    , triangles_(skin)
  {
    for (const auto& [a, b, c] : this->triangles_.all())
    {
      const auto number = std::uint32_t(this->centers_.size());
      const Vector4 p = skin.position(a), q = skin.position(b), r = skin.position(c);
      const Vector4 normal = cross(q - p, r - p);
      const float length = std::sqrt(squaredNorm(normal));
      this->normals_.push_back(length > 0.f ? 1.f / length * normal : Vector4());
      this->centers_.push_back(1.f / 3.f * (p + q + r));
      this->cells_[keyOf(cellPlace(this->centers_.back(), this->radius()))].push_back(number);
      this->moments_[keyOf(cellPlace(this->centers_.back(), this->planeCell()))].add(
        this->centers_.back().toDouble());
    }
    this->findSteepness();
  }

  /// The triangles that do not belong to the side that is kept.
  std::vector<Triangle> otherSide()
  {
    std::vector<std::uint32_t> byFlatness(this->triangles_.all().size());
    for (std::uint32_t t = 0; t < byFlatness.size(); ++t)
    {
      byFlatness[t] = t;
    }
    std::sort(byFlatness.begin(), byFlatness.end(),
      [&](std::uint32_t a, std::uint32_t b)
      { return std::tie(this->steepness_[a], a) < std::tie(this->steepness_[b], b); });
    this->sides_.assign(this->triangles_.all().size(), Side::Unknown);
    for (const std::uint32_t seed : byFlatness)
    {
      if (this->sides_[seed] == Side::Unknown)
      {
        this->flood(seed);
      }
    }
    std::vector<Triangle> result;
    for (std::size_t t = 0; t < this->triangles_.all().size(); ++t)
    {
      if (this->sides_[t] != Side::Kept)
      {
        result.push_back(this->triangles_.all()[t]);
      }
    }
    return result;
  }

private:
  enum class Side : std::uint8_t
  {
    Unknown,
    Kept,
    Other
  };

  static std::uint64_t key(int x, int y, int z)
  {
    constexpr int Bits = 21, Middle = 1 << (Bits - 1);
    return std::uint64_t(x + Middle) << 2 * Bits | std::uint64_t(y + Middle) << Bits |
      std::uint64_t(z + Middle);
  }
  static std::uint64_t keyOf(const std::array<int, 3>& place)
  {
    return key(place[0], place[1], place[2]);
  }
  static std::array<int, 3> cellPlace(Vector4 point, float width)
  {
    return { int(std::floor(point[0] / width)), int(std::floor(point[1] / width)),
      int(std::floor(point[2] / width)) };
  }
  /// Calls `use` for the content of the cells of a map around a point.
  template <typename Map, typename Use>
  static void forEachCellAround(const Map& cells, Vector4 point, float width, Use use)
  {
    const auto [x, y, z] = cellPlace(point, width);
    for (int k = z - 1; k <= z + 1; ++k)
    {
      for (int j = y - 1; j <= y + 1; ++j)
      {
        for (int i = x - 1; i <= x + 1; ++i)
        {
          const auto cell = cells.find(key(i, j, k));
          if (cell != cells.end())
          {
            use(cell->second);
          }
        }
      }
    }
  }
  float radius() const { return OtherSideDepth * this->thickness_; }
  float planeCell() const { return PlaneCell * this->thickness_; }

  /// How far a triangle is from lying in the plane of the sheet around it: 0 on a flat side, 1 on
  /// its rim. Both sides together tell that plane.
  void findSteepness()
  {
    this->steepness_.resize(this->triangles_.all().size());
    for (std::size_t t = 0; t < this->triangles_.all().size(); ++t)
    {
      Moments sum;
      forEachCellAround(this->moments_, this->centers_[t], this->planeCell(),
        [&](const Moments& moments) { sum += moments; });
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
      solver.computeDirect(sum.covariance());
      const Eigen::Vector3d across = solver.eigenvectors().col(0);
      this->steepness_[t] = float(1. - std::abs(across.dot(this->normals_[t].toDouble())));
    }
  }

  void flood(std::uint32_t seed)
  {
    using Entry = std::pair<float, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.emplace(this->steepness_[seed], seed);
    while (!open.empty())
    {
      const std::uint32_t t = open.top().second;
      open.pop();
      if (this->sides_[t] != Side::Unknown)
      {
        continue;
      }
      if (this->hasKeptSideBehind(t))
      {
        this->sides_[t] = Side::Other;
        continue;
      }
      this->sides_[t] = Side::Kept;
      this->markOtherSide(t);
      const auto& [a, b, c] = this->triangles_.all()[t];
      for (const auto& [from, to] : { std::pair(a, b), std::pair(b, c), std::pair(c, a) })
      {
        // The triangle on the other side of the edge.
        const std::uint32_t next = this->triangles_.number(to, from);
        if (this->sides_[next] == Side::Unknown)
        {
          open.emplace(this->steepness_[next], next);
        }
      }
    }
  }

  /// Whether a triangle turns its back on another one, as one side of the skin on the other side.
  bool isBackToBack(std::uint32_t t, std::uint32_t other) const
  {
    const Vector4 offset = this->centers_[other] - this->centers_[t];
    const float depth = -dot(offset, this->normals_[t]);
    const float aside = squaredNorm(offset) - depth * depth;
    const float width = OtherSideWidth * this->thickness_;
    return depth > 0.f && depth < OtherSideDepth * this->thickness_ && aside < width * width &&
      dot(this->normals_[other], this->normals_[t]) < OtherSideCosine;
  }

  void markOtherSide(std::uint32_t t)
  {
    forEachCellAround(this->cells_, this->centers_[t], this->radius(),
      [&](const std::vector<std::uint32_t>& cell)
      {
        for (const std::uint32_t other : cell)
        {
          if (this->sides_[other] == Side::Unknown && this->isBackToBack(t, other))
          {
            this->sides_[other] = Side::Other;
          }
        }
      });
  }

  /// Around a bend the outer side is the larger one: the inner side's triangles see but a part of
  /// it behind them, while all of it has the inner side behind it.
  bool hasKeptSideBehind(std::uint32_t t) const
  {
    bool result = false;
    forEachCellAround(this->cells_, this->centers_[t], this->radius(),
      [&](const std::vector<std::uint32_t>& cell)
      {
        result = result ||
          std::any_of(cell.begin(), cell.end(),
            [&](std::uint32_t other)
            { return this->sides_[other] == Side::Kept && this->isBackToBack(t, other); });
      });
    return result;
  }

  const Mesh& skin_;
  float thickness_;
  NumberedTriangles triangles_;
  std::vector<Vector4> normals_;
  std::vector<Vector4> centers_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
  std::unordered_map<std::uint64_t, Moments> moments_;
  std::vector<float> steepness_;
  std::vector<Side> sides_;
};
}

bool keepOneSheet(Mesh& skin, float thickness)
{
  skin.removeTriangles(SheetFlood(skin, thickness).otherSide());
  skin.removeTriangles(findSmallPieces(skin));
  BoundaryManager boundaries(skin);
  fillBoundaries(skin, boundaries, LongestFilledEdge * double(thickness));
  skin.dropErased();
  return skin.vertexCount() > 3;
}
}
