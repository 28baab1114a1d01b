// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ManifoldSurface.h"

#include "base/DisjointSets.h"
#include "base/WarningTopic.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t NoSide = std::size_t(-1);

/// The side from a corner to the next one of its triangle, which bears the number of the corner.
struct CutSide
{
  std::uint32_t low;
  std::uint32_t high;
  std::size_t corner;

  bool isSameEdge(const CutSide& other) const { return low == other.low && high == other.high; }
  friend bool operator<(const CutSide& a, const CutSide& b)
  {
    return std::tie(a.low, a.high, a.corner) < std::tie(b.low, b.high, b.corner);
  }
};

std::size_t cornerAfter(std::size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

bool isBeforeByPlace(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
}

/// For each point the first one at the same place.
std::vector<std::uint32_t> firstAtPlaces(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<std::uint32_t> order, result(points.size());
  std::iota(result.begin(), result.end(), 0u);
  std::copy_if(result.begin(), result.end(), std::back_inserter(order),
    [&](std::uint32_t i) { return points[i].allFinite(); });
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return isBeforeByPlace(points[a], points[b]); });
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    if (!isBeforeByPlace(points[order[i - 1]], points[order[i]]))
    {
      result[order[i]] = result[order[i - 1]];
    }
  }
  return result;
}

class SurfaceCutter
{
public:
  explicit SurfaceCutter(const TriangleMesh& triangles)
  {
    surface_.mesh.points = triangles.points;
    takeTriangles(triangles);
    if (!mesh().triangles.empty())
    {
      linkSides();
      orient();
      partFans();
      openEdges();
    }
    dropUnusedPoints();
  }

  ManifoldSurface surface() { return std::move(surface_); }

private:
  TriangleMesh& mesh() { return surface_.mesh; }
  std::uint32_t& pointAt(std::size_t corner) { return mesh().triangles[corner / 3][corner % 3]; }
  std::size_t cornerCount() { return 3 * mesh().triangles.size(); }

  void takeTriangles(const TriangleMesh& triangles)
  {
    const std::vector<std::uint32_t> first = firstAtPlaces(triangles.points);
    using Ids = std::array<std::uint32_t, 3>;
    std::vector<std::pair<Ids, std::uint32_t>> sorted;
    for (std::uint32_t i = 0; i < triangles.triangles.size(); ++i)
    {
      Ids ids{};
      bool isFinite = true;
      for (std::size_t k = 0; k < 3; ++k)
      {
        ids[k] = first[triangles.triangles[i][k]];
        isFinite = isFinite && triangles.points[ids[k]].allFinite();
      }
      std::sort(ids.begin(), ids.end());
      if (!isFinite || ids[0] == ids[1] || ids[1] == ids[2])
      {
        ++surface_.leftOut;
        continue;
      }
      sorted.emplace_back(ids, i);
    }
    std::sort(sorted.begin(), sorted.end());
    const auto end = std::unique(sorted.begin(), sorted.end(),
      [](const auto& a, const auto& b) { return a.first == b.first; });
    surface_.leftOut += std::size_t(sorted.end() - end);
    sorted.erase(end, sorted.end());
    std::sort(sorted.begin(), sorted.end(),
      [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [ids, i] : sorted)
    {
      const auto& [a, b, c] = triangles.triangles[i];
      mesh().triangles.push_back({ first[a], first[b], first[c] });
      surface_.origins.push_back(i);
    }
  }

  std::vector<CutSide> sortedSides()
  {
    std::vector<CutSide> sides;
    sides.reserve(cornerCount());
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      const std::uint32_t from = pointAt(corner), to = pointAt(cornerAfter(corner));
      sides.push_back({ std::min(from, to), std::max(from, to), corner });
    }
    std::sort(sides.begin(), sides.end());
    return sides;
  }

  /// Calls `use(first, last)` for the sides of each edge.
  template <typename Use>
  void forEachEdge(const std::vector<CutSide>& sides, const Use& use)
  {
    for (auto first = sides.begin(); first != sides.end();)
    {
      const auto last = std::find_if(
        first, sides.end(), [&](const CutSide& side) { return !side.isSameEdge(*first); });
      use(first, last);
      first = last;
    }
  }

  /// Where two triangles meet at an edge they go on into each other.
  void linkSides()
  {
    opposite_.assign(cornerCount(), NoSide);
    forEachEdge(sortedSides(),
      [this](auto first, auto last)
      {
        surface_.cutEdges += last - first > 2 ? 1 : 0;
        if (last - first == 2)
        {
          opposite_[first->corner] = (first + 1)->corner;
          opposite_[(first + 1)->corner] = first->corner;
        }
      });
  }

  double areaOfTriangle(std::size_t triangle)
  {
    const auto& [a, b, c] = mesh().triangles[triangle];
    const Eigen::Vector3d& corner = mesh().points[a];
    return (mesh().points[b] - corner).cross(mesh().points[c] - corner).norm();
  }

  /// Turns triangles so that each goes on into its neighbours, from one to the next, and cuts where that cannot be.
  void orient()
  {
    const std::size_t count = mesh().triangles.size();
    std::vector<std::uint8_t> isSeen(count, 0), isTurned(count, 0);
    // A link holds if exactly one of both runs against the way they run now.
    const auto agrees = [&](std::size_t corner)
    {
      const std::size_t other = opposite_[corner];
      const bool runsAlike = pointAt(corner) == pointAt(other);
      return runsAlike == (isTurned[corner / 3] != isTurned[other / 3]);
    };
    std::vector<std::size_t> piece;
    for (std::size_t start = 0; start < count; ++start)
    {
      if (isSeen[start])
      {
        continue;
      }
      piece.clear();
      piece.push_back(start);
      isSeen[start] = 1;
      double turnedArea = 0., area = 0.;
      for (std::size_t i = 0; i < piece.size(); ++i)
      {
        const std::size_t triangle = piece[i];
        area += areaOfTriangle(triangle);
        turnedArea += isTurned[triangle] ? areaOfTriangle(triangle) : 0.;
        for (std::size_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner)
        {
          const std::size_t next = opposite_[corner] == NoSide ? NoSide : opposite_[corner] / 3;
          if (next != NoSide && !isSeen[next])
          {
            isSeen[next] = 1;
            isTurned[next] = isTurned[triangle];
            isTurned[next] = agrees(corner) ? isTurned[next] : std::uint8_t(1 - isTurned[next]);
            piece.push_back(next);
          }
        }
      }
      if (turnedArea > 0.5 * area)
      {
        for (const std::size_t triangle : piece)
        {
          isTurned[triangle] = std::uint8_t(1 - isTurned[triangle]);
        }
      }
    }
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      if (opposite_[corner] != NoSide && !agrees(corner))
      {
        opposite_[opposite_[corner]] = NoSide;
        opposite_[corner] = NoSide;
        ++surface_.cutEdges;
      }
    }
    for (std::size_t triangle = 0; triangle < count; ++triangle)
    {
      if (isTurned[triangle])
      {
        // The side from the second to the third corner stays in its place, the others change theirs.
        std::swap(mesh().triangles[triangle][1], mesh().triangles[triangle][2]);
        swapSides(3 * triangle, 3 * triangle + 2);
      }
    }
  }

  void swapSides(std::size_t a, std::size_t b)
  {
    std::swap(opposite_[a], opposite_[b]);
    for (const std::size_t corner : { a, b })
    {
      if (opposite_[corner] != NoSide)
      {
        opposite_[opposite_[corner]] = corner;
      }
    }
  }

  /// Each fan around a point gets a point of its own.
  void partFans()
  {
    DisjointSets fans(cornerCount());
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      if (opposite_[corner] != NoSide)
      {
        // The two run along their edge against each other.
        fans.join(corner, cornerAfter(opposite_[corner]));
      }
    }
    std::vector<std::size_t> fanOfPoint(mesh().points.size(), NoSide);
    std::vector<std::uint32_t> pointOfFan(cornerCount(), 0);
    std::vector<std::uint8_t> hasPoint(cornerCount(), 0);
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      const std::size_t fan = fans.root(corner);
      const std::uint32_t point = pointAt(corner);
      if (!hasPoint[fan])
      {
        hasPoint[fan] = 1;
        pointOfFan[fan] = point;
        if (fanOfPoint[point] != NoSide)
        {
          pointOfFan[fan] = addPoint(mesh().points[point]);
        }
        fanOfPoint[point] = fan;
      }
      pointAt(corner) = pointOfFan[fan];
    }
  }

  std::uint32_t addPoint(const Eigen::Vector3d& point)
  {
    mesh().points.push_back(point);
    return std::uint32_t(mesh().points.size() - 1);
  }

  /// Where sides that do not go on into each other have the same ends still, each gets a point in its middle.
  void openEdges()
  {
    std::set<std::size_t> opened;
    forEachEdge(sortedSides(),
      [&](auto first, auto last)
      {
        const bool isLinked = last - first == 2 && opposite_[first->corner] != NoSide;
        for (auto side = first; last - first > 1 && !isLinked && side != last; ++side)
        {
          if (opposite_[side->corner] == NoSide)
          {
            opened.insert(side->corner);
          }
        }
      });
    while (!opened.empty())
    {
      const std::size_t triangle = *opened.begin() / 3;
      const auto corners = mesh().triangles[triangle];
      std::vector<std::uint32_t> outline;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k)
      {
        outline.push_back(corners[k]);
        sum += mesh().points[corners[k]] / 3.;
        if (opened.erase(3 * triangle + k) > 0)
        {
          outline.push_back(
            addPoint(0.5 * mesh().points[corners[k]] + 0.5 * mesh().points[corners[(k + 1) % 3]]));
        }
      }
      const std::uint32_t middle = addPoint(sum);
      const std::uint32_t origin = surface_.origins[triangle];
      for (std::size_t i = 0; i < outline.size(); ++i)
      {
        const std::array<std::uint32_t, 3> part{ middle, outline[i],
          outline[(i + 1) % outline.size()] };
        if (i == 0)
        {
          mesh().triangles[triangle] = part;
          continue;
        }
        mesh().triangles.push_back(part);
        surface_.origins.push_back(origin);
      }
    }
  }

  void dropUnusedPoints()
  {
    std::vector<std::uint32_t> numberOf(mesh().points.size(), 0);
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      numberOf[pointAt(corner)] = 1;
    }
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < numberOf.size(); ++i)
    {
      if (numberOf[i] > 0)
      {
        mesh().points[count] = mesh().points[i];
        numberOf[i] = count++;
      }
    }
    mesh().points.resize(count);
    for (std::size_t corner = 0; corner < cornerCount(); ++corner)
    {
      pointAt(corner) = numberOf[pointAt(corner)];
    }
  }

  ManifoldSurface surface_;
  std::vector<std::size_t> opposite_; ///< of each side, the one that it goes on into
};
}

ManifoldSurface manifoldOf(const TriangleMesh& triangles)
{
  return SurfaceCutter(triangles).surface();
}

std::string warningOfSurface(const ManifoldSurface& surface)
{
  if (surface.leftOut == 0 && surface.cutEdges == 0)
  {
    return "";
  }
  std::string text = "The surface is no oriented manifold.";
  if (surface.leftOut > 0)
  {
    text += " The program left out triangles that are repeated, use a point twice, or have a point "
            "that is not finite: " +
      std::to_string(surface.leftOut) + ".";
  }
  if (surface.cutEdges > 0)
  {
    text +=
      " The program cut it along edges where more than two triangles meet or sides disagree: " +
      std::to_string(surface.cutEdges) + ".";
  }
  return taggedWarning(WarningTopic::SurfaceIsUnsound, text + " Repair it first if this matters.");
}
}
