// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/Visibility.h"

#include <numeric>

namespace neuralmesh
{
namespace
{
using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/// As a fraction of the diagonal.
constexpr double HitTolerance = 1e-6;
/// As a fraction of a triangle: nothing is seen through the edge between two.
constexpr double Rim = 1e-12;

TriangleCorners cornersOf(const TriangleMesh& surface, std::uint32_t triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return { surface.points[a], surface.points[b], surface.points[c] };
}

Eigen::AlignedBox3d boxOf(const TriangleCorners& corners)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : corners)
  {
    box.extend(corner);
  }
  return box;
}

/// Looks for a triangle that meets a segment: what Eigen::BVIntersect() asks.
class SegmentSearch
{
public:
  SegmentSearch(
    const TriangleMesh& surface, const Eigen::Vector3d& begin, const Eigen::Vector3d& end)
    : surface_(surface)
    , begin_(begin)
    , way_(end - begin)
  {
  }

  bool isFound() const { return isFound_; }

  /// By separating axes: those of the box, and their cross products with the segment.
  bool intersectVolume(const Eigen::AlignedBox3d& box) const
  {
    const Eigen::Vector3d half = 0.5 * way_, reach = half.cwiseAbs();
    const Eigen::Vector3d extent = 0.5 * box.sizes();
    const Eigen::Vector3d between = begin_ + half - box.center();
    if ((between.cwiseAbs().array() > (extent + reach).array()).any())
    {
      return false;
    }
    const Eigen::Vector3d across = between.cross(half).cwiseAbs();
    for (int k = 0; k < 3; ++k)
    {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const double limit = extent[i] * reach[j] + extent[j] * reach[i];
      // What rounding makes of the cross product of parallels must not separate.
      if (across[k] > limit + 1e-14 * between.cwiseAbs().maxCoeff() * reach.maxCoeff())
      {
        return false;
      }
    }
    return true;
  }

  /// T. Moeller, B. Trumbore, Fast, minimum storage ray-triangle intersection, 1997.
  bool intersectObject(std::uint32_t triangle)
  {
    const auto [a, b, c] = cornersOf(surface_, triangle);
    const Eigen::Vector3d ab = b - a, ac = c - a, fromA = begin_ - a;
    const Eigen::Vector3d normal = way_.cross(ac), across = fromA.cross(ab);
    const double determinant = ab.dot(normal);
    const double u = fromA.dot(normal) / determinant;
    const double v = way_.dot(across) / determinant;
    const double place = ac.dot(across) / determinant;
    // All false where the segment is parallel to the triangle.
    isFound_ = u >= -Rim && v >= -Rim && u + v <= 1. + Rim && place >= 0. && place <= 1.;
    return isFound_;
  }

private:
  const TriangleMesh& surface_;
  Eigen::Vector3d begin_;
  Eigen::Vector3d way_;
  bool isFound_ = false;
};
}

Visibility::Visibility(const TriangleMesh& surface)
  : surface_(surface)
{
  std::vector<std::uint32_t> indices(surface.triangles.size());
  std::iota(indices.begin(), indices.end(), 0u);
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(indices.size());
  Eigen::AlignedBox3d bounds;
  for (const std::uint32_t triangle : indices)
  {
    bounds.extend(boxes.emplace_back(boxOf(cornersOf(surface, triangle))));
  }
  tree_.init(indices.begin(), indices.end(), boxes.begin(), boxes.end());
  tolerance_ = boxes.empty() ? 0. : HitTolerance * bounds.diagonal().norm();
}

bool Visibility::isSeen(const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint) const
{
  const Eigen::Vector3d way = point - viewpoint;
  const double length = way.norm();
  if (length <= tolerance_)
  {
    return true;
  }
  SegmentSearch search(surface_, viewpoint, viewpoint + (1. - tolerance_ / length) * way);
  Eigen::BVIntersect(tree_, search);
  return !search.isFound();
}

bool Visibility::isHidden(
  const Eigen::Vector3d& point, const Eigen::Vector3d& viewpoint, double distance) const
{
  const Eigen::Vector3d way = viewpoint - point;
  const double length = way.norm();
  return length > distance && !isSeen(point + distance / length * way, viewpoint);
}
}
