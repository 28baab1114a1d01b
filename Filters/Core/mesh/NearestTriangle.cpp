// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NearestTriangle.h"

#include "base/TouchedVector.h"
#include "mesh/BoxTree.h"
#include "mesh/EachVertex.h"
#include "mesh/TriangleList.h"

#include <algorithm>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Parts for the executor.
constexpr std::uint32_t TrianglesOfBranch = 4096;
constexpr std::size_t TreeTrianglesPerRange = 4096;
constexpr std::size_t TrianglesTakenAtOnce = 262144;
/// Halves of 2^32 triangles, one after the other, and a node that waits for each.
constexpr std::size_t DeepestTree = 40;
/// A triangle whose height is less than this part of its longest edge is a sliver.
constexpr double SliverHeight = 1e-3;

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

Eigen::AlignedBox3d boxAround(const TriangleCorners& corners)
{
  Eigen::AlignedBox3d box(corners[0]);
  box.extend(corners[1]);
  box.extend(corners[2]);
  return box;
}

/// The height, as a part of the longest edge; 0 if there is no area.
double heightPart(const TriangleCorners& corners)
{
  const Eigen::Vector3d ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  const double longest =
    std::max({ ab.squaredNorm(), ac.squaredNorm(), (corners[2] - corners[1]).squaredNorm() });
  return longest > 0. ? ab.cross(ac).norm() / longest : 0.;
}

/// The centre of their box.
Eigen::Vector3d centerOfBox(const TriangleCorners& corners)
{
  return 0.5 * corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]) +
    0.5 * corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
}

std::array<std::uint32_t, 3> inRisingOrder(std::array<std::uint32_t, 3> ids)
{
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Looks for the place nearest to a point on the triangles that it is shown. Whatever is rounded, a place
/// stays within the box of its triangle: so no triangle is nearer than its box, to the last bit.
class NearestPlace
{
public:
  NearestPlace(const Eigen::Vector3d& point, double mostSquared)
    : point_(point)
  {
    found_.squaredDistance = mostSquared;
  }

  double squaredDistanceTo(const Eigen::AlignedBox3d& box) const
  {
    return (point_ - point_.cwiseMax(box.min()).cwiseMin(box.max())).squaredNorm();
  }

  void lookAt(const TriangleCorners& corners, std::uint32_t index, bool isSliver)
  {
    const auto& [a, b, c] = corners;
    const Eigen::Vector3d ab = b - a, ac = c - a, toPoint = point_ - a;
    const Eigen::Vector3d normal = ab.cross(ac);
    const double squared = normal.squaredNorm();
    const double alongB = toPoint.cross(ac).dot(normal), alongC = ab.cross(toPoint).dot(normal);
    // What overflows is on the edges.
    const bool isInside = alongB > 0. && alongC > 0. && alongB + alongC < squared &&
      squared < std::numeric_limits<double>::infinity();
    if (isInside)
    {
      const Eigen::Vector3d place = a + alongB / squared * ab + alongC / squared * ac;
      keep(place, a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), index);
    }
    if (!isInside || isSliver)
    {
      lookAtEdge(a, b, index);
      lookAtEdge(b, c, index);
      lookAtEdge(a, c, index);
    }
  }

  const NearestTriangle::Found& found() const { return found_; }

private:
  void lookAtEdge(const Eigen::Vector3d& a, const Eigen::Vector3d& b, std::uint32_t index)
  {
    const Eigen::Vector3d edge = b - a;
    const double along = edge.dot(point_ - a), squared = edge.squaredNorm();
    // Written so that a quotient that is no number is the first end.
    if (!(along > 0.))
    {
      keep(a, a, a, index);
    }
    else if (along >= squared)
    {
      keep(b, b, b, index);
    }
    else
    {
      keep(a + along / squared * edge, a.cwiseMin(b), a.cwiseMax(b), index);
    }
  }

  void keep(const Eigen::Vector3d& about, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
    std::uint32_t index)
  {
    const Eigen::Vector3d place = about.cwiseMax(low).cwiseMin(high);
    const double squared = (point_ - place).squaredNorm();
    if (squared < found_.squaredDistance ||
      (squared == found_.squaredDistance && index < found_.triangle))
    {
      found_ = { place, squared, index };
    }
  }

  Eigen::Vector3d point_;
  NearestTriangle::Found found_;
};
}

NearestTriangle::NearestTriangle(const TriangleMesh& mesh, const Executor& executor)
  : NearestTriangle(mesh.points, mesh.triangles, executor)
{
}

NearestTriangle::NearestTriangle(std::vector<Eigen::Vector3d> points,
  std::span<const std::array<std::uint32_t, 3>> triangles, const Executor& executor)
  : points_(std::move(points))
{
  const auto count = std::uint32_t(triangles.size());
  LargeVector<Item> items = itemsOf(triangles, executor);
  const std::vector<Branch> branches = ordered(items, executor);
  take(std::move(items), triangles, executor);
  nodes_ = touchedVector<LargeVector<Node>>(BoxTreeShape::nodeCount(count), executor);
  executor.forEachPart(branches.size(), [&](std::size_t i) { build(branches[i]); });
  join({ 0, 0, count });
}

LargeVector<NearestTriangle::Item> NearestTriangle::itemsOf(
  std::span<const std::array<std::uint32_t, 3>> triangles, const Executor& executor) const
{
  auto items = touchedVector<LargeVector<Item>>(triangles.size(), executor);
  executor.forEachRange(triangles.size(), TreeTrianglesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const auto& [a, b, c] = triangles[i];
        const Eigen::Vector3d center = centerOfBox({ points_[a], points_[b], points_[c] });
        items[i] = { (center - points_.front()).cast<float>(), std::uint32_t(i) };
      }
    });
  return items;
}

/// Puts those of a leaf beside each other. The branches are those that are built by themselves.
std::vector<NearestTriangle::Branch> NearestTriangle::ordered(
  LargeVector<Item>& items, const Executor& executor)
{
  // Those of a level are equally large, but for one triangle.
  std::vector<Branch> branches;
  branches.push_back({ 0, 0, std::uint32_t(items.size()) });
  while (branches.front().size() > TrianglesOfBranch)
  {
    executor.forEachPart(branches.size(), [&](std::size_t i) { halve(items, branches[i]); });
    std::vector<Branch> halves;
    for (const Branch& branch : branches)
    {
      halves.push_back(branch.first());
      halves.push_back(branch.second());
    }
    branches = std::move(halves);
  }
  executor.forEachPart(branches.size(), [&](std::size_t i) { order(items, branches[i]); });
  return branches;
}

/// What is taken gives its memory back, so that there is less of both.
void NearestTriangle::take(LargeVector<Item> items,
  std::span<const std::array<std::uint32_t, 3>> triangles, const Executor& executor)
{
  triangles_ = ZeroedArray<Triangle>(items.size());
  for (std::size_t first = 0; first < items.size(); first += TrianglesTakenAtOnce)
  {
    const std::size_t size = std::min(TrianglesTakenAtOnce, items.size() - first);
    executor.forEachRange(size, TreeTrianglesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t i = first + begin; i < first + end; ++i)
        {
          Triangle& triangle = triangles_[i];
          triangle = { inRisingOrder(triangles[items[i].index]), items[i].index, false };
          triangle.isSliver = heightPart(cornersOf(triangle)) < SliverHeight;
        }
      });
    LargePageAllocator<Item>::releaseFirst(items.data(), items.capacity(), first + size);
  }
}

NearestTriangle::Branch NearestTriangle::Branch::second() const
{
  return { node + 1 + BoxTreeShape::nodeCount(middle() - begin), middle(), end };
}

/// Across its longer side.
void NearestTriangle::halve(std::span<Item> items, const Branch& branch)
{
  Eigen::AlignedBox3f centers;
  for (const Item& item : items.subspan(branch.begin, branch.size()))
  {
    centers.extend(item.center);
  }
  Eigen::Index axis = 0;
  (centers.max() - centers.min()).maxCoeff(&axis);
  const auto first = items.begin();
  std::nth_element(first + branch.begin, first + branch.middle(), first + branch.end,
    [axis](const Item& a, const Item& b) { return a.center[axis] < b.center[axis]; });
}

/// All the way down to the leaves.
void NearestTriangle::order(std::span<Item> items, const Branch& branch)
{
  if (branch.size() > BoxTreeShape::ItemsOfLeaf)
  {
    halve(items, branch);
    order(items, branch.first());
    order(items, branch.second());
  }
}

void NearestTriangle::build(const Branch& branch)
{
  if (branch.size() == 0)
  {
    return;
  }
  if (branch.size() > BoxTreeShape::ItemsOfLeaf)
  {
    build(branch.first());
    build(branch.second());
    joinChildren(branch);
    return;
  }
  Node& node = nodes_[branch.node];
  node = { {}, branch.begin, branch.size() };
  for (std::uint32_t i = branch.begin; i < branch.end; ++i)
  {
    node.box.extend(boxAround(cornersOf(triangles_[i])));
  }
}

/// What lies above the branches that are built by themselves.
void NearestTriangle::join(const Branch& branch)
{
  if (branch.size() > TrianglesOfBranch)
  {
    join(branch.first());
    join(branch.second());
    joinChildren(branch);
  }
}

void NearestTriangle::joinChildren(const Branch& branch)
{
  const std::uint32_t first = branch.first().node, second = branch.second().node;
  nodes_[branch.node] = { nodes_[first].box.merged(nodes_[second].box), second, 0 };
}

NearestTriangle::Found NearestTriangle::find(
  const Eigen::Vector3d& point, double squaredDistance) const
{
  NearestPlace nearest(point, squaredDistance);
  if (nodes_.empty() || !point.allFinite())
  {
    return nearest.found();
  }
  struct Waiting
  {
    double squaredDistance;
    std::uint32_t node;
  };
  std::array<Waiting, DeepestTree> waiting{};
  std::size_t count = 0;
  waiting[count++] = { nearest.squaredDistanceTo(nodes_[0].box), 0 };
  while (count > 0)
  {
    const Waiting next = waiting[--count];
    if (next.squaredDistance > nearest.found().squaredDistance)
    {
      continue;
    }
    const Node& node = nodes_[next.node];
    if (node.isLeaf())
    {
      for (std::uint32_t i = node.next; i < node.next + node.count; ++i)
      {
        nearest.lookAt(cornersOf(triangles_[i]), triangles_[i].index, triangles_[i].isSliver);
      }
      continue;
    }
    Waiting near{ nearest.squaredDistanceTo(nodes_[next.node + 1].box), next.node + 1 };
    Waiting far{ nearest.squaredDistanceTo(nodes_[node.next].box), node.next };
    if (far.squaredDistance < near.squaredDistance)
    {
      std::swap(near, far);
    }
    waiting[count++] = far;
    waiting[count++] = near;
  }
  return nearest.found();
}

TriangleMesh trianglesIn(const Mesh& mesh, const Executor& executor)
{
  TriangleMesh result{ std::vector<Eigen::Vector3d>(mesh.indexEnd()),
    triangleList(mesh, executor) };
  forEachVertex(mesh, executor, TreeTrianglesPerRange,
    [&](VertexIndex v) { result.points[v] = mesh.position(v).toDouble(); });
  return result;
}
}
