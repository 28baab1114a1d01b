// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LeastCut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace neuralmesh
{
namespace
{
/// Lengths are whole numbers: sums of them have no order. The mean edge of the piece has this one.
constexpr double MeanLength = 256.;
/// So many triangles of a piece, times their number, are looked at before the search is given up.
constexpr std::size_t MostLooks = 100;

class Flow
{
public:
  Flow(const TriangleMesh& mesh, const TriangleNeighbors& neighbors,
    std::span<const std::uint32_t> piece, std::vector<std::int8_t>& sides)
    : mesh_(mesh)
    , neighbors_(neighbors)
    , piece_(piece)
    , sides_(sides)
    , left_(mesh.triangles.size(), { 0, 0, 0 })
    , steps_(mesh.triangles.size(), Unreached)
    , tried_(mesh.triangles.size(), 0)
  {
    double sum = 0.;
    forEachSide([&](std::uint32_t t, std::size_t side) { sum += length(t, side); });
    const double unit = sum / (MeanLength * 3. * double(std::max<std::size_t>(1, piece.size())));
    forEachSide(
      [&](std::uint32_t t, std::size_t side)
      {
        left_[t][side] = unit > 0. && neighbors_[t][side] != NoTriangle
          ? 1 + std::llround(length(t, side) / unit)
          : 0;
      });
  }

  /// Returns false if that takes too long: then the sides are as they were.
  bool divide()
  {
    while (findSteps())
    {
      if (looks_ > MostLooks * piece_.size())
      {
        return false;
      }
      for (const std::uint32_t t : piece_)
      {
        tried_[t] = 0;
      }
      for (const std::uint32_t t : piece_)
      {
        if (sides_[t] > 0)
        {
          sendFrom(t);
        }
      }
    }
    for (const std::uint32_t t : piece_)
    {
      sides_[t] = steps_[t] != Unreached ? 1 : -1;
    }
    return true;
  }

private:
  static constexpr std::uint32_t Unreached = std::numeric_limits<std::uint32_t>::max();

  struct Edge
  {
    std::uint32_t triangle;
    std::size_t side;
  };

  template <typename Use>
  void forEachSide(Use use) const
  {
    for (const std::uint32_t t : piece_)
    {
      for (std::size_t side = 0; side < 3; ++side)
      {
        use(t, side);
      }
    }
  }

  double length(std::uint32_t triangle, std::size_t side) const
  {
    const auto& corners = mesh_.triangles[triangle];
    return (mesh_.points[corners[(side + 1) % 3]] - mesh_.points[corners[side]]).norm();
  }

  /// How many steps each triangle is from those of side 1, across edges with room left. Returns whether one of the
  /// other side is reached.
  bool findSteps()
  {
    std::vector<std::uint32_t> reached;
    reached.reserve(piece_.size());
    for (const std::uint32_t t : piece_)
    {
      steps_[t] = sides_[t] > 0 ? 0 : Unreached;
      if (sides_[t] > 0)
      {
        reached.push_back(t);
      }
    }
    looks_ += piece_.size();
    bool isOtherReached = false;
    for (std::size_t i = 0; i < reached.size(); ++i)
    {
      const std::uint32_t t = reached[i];
      if (sides_[t] < 0)
      {
        isOtherReached = true;
        continue;
      }
      for (std::size_t side = 0; side < 3; ++side)
      {
        const std::uint32_t other = neighbors_[t][side];
        if (left_[t][side] > 0 && steps_[other] == Unreached)
        {
          steps_[other] = steps_[t] + 1;
          reached.push_back(other);
        }
      }
    }
    return isOtherReached;
  }

  /// Sends as much as there is room for on shortest ways to the other side.
  void sendFrom(std::uint32_t start)
  {
    way_.clear();
    std::uint32_t at = start;
    while (looks_ <= MostLooks * piece_.size())
    {
      ++looks_;
      std::uint8_t& side = tried_[at];
      while (side < 3 && !leadsOn(at, side))
      {
        ++side;
      }
      if (side == 3)
      {
        if (way_.empty())
        {
          return;
        }
        at = way_.back().triangle;
        way_.pop_back();
        ++tried_[at];
        continue;
      }
      way_.push_back({ at, side });
      at = neighbors_[at][side];
      if (sides_[at] < 0)
      {
        send();
        way_.clear();
        at = start;
      }
    }
  }

  bool leadsOn(std::uint32_t triangle, std::size_t side) const
  {
    return left_[triangle][side] > 0 && steps_[neighbors_[triangle][side]] == steps_[triangle] + 1;
  }

  void send()
  {
    std::int64_t room = std::numeric_limits<std::int64_t>::max();
    for (const auto& [triangle, side] : way_)
    {
      room = std::min(room, left_[triangle][side]);
    }
    for (const Edge& edge : way_)
    {
      const Edge back = otherSide(edge);
      left_[edge.triangle][edge.side] -= room;
      left_[back.triangle][back.side] += room;
    }
  }

  /// The same edge from the triangle across it.
  Edge otherSide(const Edge& edge) const
  {
    const std::uint32_t other = neighbors_[edge.triangle][edge.side];
    const std::uint32_t from = mesh_.triangles[edge.triangle][(edge.side + 1) % 3];
    const auto& corners = mesh_.triangles[other];
    return { other,
      std::size_t(std::find(corners.begin(), corners.end(), from) - corners.begin()) };
  }

  const TriangleMesh& mesh_;
  const TriangleNeighbors& neighbors_;
  std::span<const std::uint32_t> piece_;
  std::vector<std::int8_t>& sides_;
  std::vector<std::array<std::int64_t, 3>> left_; ///< room across each side
  std::vector<std::uint32_t> steps_;
  std::vector<std::uint8_t> tried_; ///< sides that lead to nothing more
  std::vector<Edge> way_;
  std::size_t looks_ = 0;
};

/// The others get the side of those that are the fewest triangles away.
void spread(const TriangleNeighbors& neighbors, std::span<const std::uint32_t> piece,
  std::vector<std::int8_t>& sides)
{
  std::vector<std::uint32_t> reached;
  reached.reserve(piece.size());
  std::copy_if(piece.begin(), piece.end(), std::back_inserter(reached),
    [&](std::uint32_t t) { return sides[t] != 0; });
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    for (const std::uint32_t other : neighbors[reached[i]])
    {
      if (other != NoTriangle && sides[other] == 0)
      {
        sides[other] = sides[reached[i]];
        reached.push_back(other);
      }
    }
  }
}
}

TriangleNeighbors neighborsIn(const TriangleMesh& mesh)
{
  struct HalfEdge
  {
    std::uint64_t key;
    std::uint32_t triangle;
    std::uint32_t side;
  };
  std::vector<HalfEdge> halfEdges;
  halfEdges.reserve(3 * mesh.triangles.size());
  const auto keyOf = [](std::uint32_t from, std::uint32_t to)
  { return std::uint64_t(from) << 32 | to; };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (std::uint32_t side = 0; side < 3; ++side)
    {
      const auto& triangle = mesh.triangles[t];
      halfEdges.push_back({ keyOf(triangle[side], triangle[(side + 1) % 3]), t, side });
    }
  }
  std::sort(halfEdges.begin(), halfEdges.end(),
    [](const HalfEdge& a, const HalfEdge& b) { return a.key < b.key; });
  TriangleNeighbors result(mesh.triangles.size(), { NoTriangle, NoTriangle, NoTriangle });
  for (const HalfEdge& edge : halfEdges)
  {
    const std::uint64_t back = edge.key << 32 | edge.key >> 32;
    const auto other = std::lower_bound(halfEdges.begin(), halfEdges.end(), back,
      [](const HalfEdge& a, std::uint64_t key) { return a.key < key; });
    if (other != halfEdges.end() && other->key == back)
    {
      result[edge.triangle][edge.side] = other->triangle;
    }
  }
  return result;
}

void divideByLeastCut(const TriangleMesh& mesh, const TriangleNeighbors& neighbors,
  std::span<const std::uint32_t> piece, std::vector<std::int8_t>& sides)
{
  if (!Flow(mesh, neighbors, piece, sides).divide())
  {
    spread(neighbors, piece, sides);
  }
}
}
