// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TurnedParts.h"

#include "base/DisjointSets.h"
#include "mesh/WindingNumber.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <queue>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A triangle has a side beyond that winding number, see WindingNumber::atTriangle().
constexpr float LeastWinding = 0.35f;
/// So large a part of its piece is one.
constexpr double LeastPart = 0.03;
/// What it hangs by is narrow if the square of its length is less than so many of its areas.
constexpr double MostSquaredSeam = 1.;
/// A piece with fewer triangles has no parts.
constexpr std::size_t LeastTriangles = 100;
/// Asked for the share, of all pieces.
constexpr std::size_t TrianglesAsked = 4000;
constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

double areaOf(const TriangleMesh& mesh, std::uint32_t triangle)
{
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3d from = mesh.points[a];
  return 0.5 * (mesh.points[b] - from).cross(mesh.points[c] - from).norm();
}

/// The triangles of each piece.
std::vector<std::vector<std::uint32_t>> piecesOf(const TriangleMesh& mesh)
{
  DisjointSets sets(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles)
  {
    sets.join(a, b);
    sets.join(b, c);
  }
  std::vector<std::uint32_t> pieceOf(mesh.points.size(), None);
  std::vector<std::vector<std::uint32_t>> pieces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    std::uint32_t& piece = pieceOf[sets.root(mesh.triangles[t][0])];
    if (piece == None)
    {
      piece = std::uint32_t(pieces.size());
      pieces.emplace_back();
    }
    pieces[piece].push_back(t);
  }
  return pieces;
}

/// The triangles across the three sides of each, or None.
using Neighbors = std::vector<std::array<std::uint32_t, 3>>;

Neighbors neighborsIn(const TriangleMesh& mesh)
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
  Neighbors result(mesh.triangles.size(), { None, None, None });
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

/// Which side each triangle of a piece shows, 1 or -1: those that tell, and what is nearer to these than to
/// others. From the clearest ones on, so that they meet where nothing tells.
void spreadSides(const std::vector<std::uint32_t>& piece, const std::vector<float>& winding,
  const Neighbors& neighbors, std::vector<std::int8_t>& sides)
{
  struct Step
  {
    float clearness;
    std::uint32_t triangle;
    std::int8_t side;

    bool operator<(const Step& other) const
    {
      return clearness != other.clearness ? clearness < other.clearness : triangle > other.triangle;
    }
  };
  std::priority_queue<Step> steps;
  for (const std::uint32_t t : piece)
  {
    if (std::abs(winding[t]) >= LeastWinding)
    {
      steps.push({ 1.f, t, std::int8_t(winding[t] > 0.f ? 1 : -1) });
    }
  }
  while (!steps.empty())
  {
    const Step step = steps.top();
    steps.pop();
    if (sides[step.triangle] != 0)
    {
      continue;
    }
    sides[step.triangle] = step.side;
    for (const std::uint32_t other : neighbors[step.triangle])
    {
      if (other != None && sides[other] == 0)
      {
        steps.push({ std::min(std::abs(winding[other]), LeastWinding), other, step.side });
      }
    }
  }
}

/// A part of a piece that shows one side.
struct Part
{
  double area = 0.;
  double seam = 0.; ///< length of the edges to parts that show the other side
  std::int8_t side = 0;
};

/// Parts of all pieces that are to be cut off.
class TurnedParts
{
public:
  explicit TurnedParts(const TriangleMesh& mesh)
    : mesh_(mesh)
    , neighbors_(neighborsIn(mesh))
    , sides_(mesh.triangles.size(), 0)
    , isOff_(mesh.triangles.size(), 0)
  {
  }

  /// Returns how many there are in a piece.
  std::size_t add(const std::vector<std::uint32_t>& piece, const std::vector<float>& winding)
  {
    spreadSides(piece, winding, neighbors_, sides_);
    DisjointSets sets(mesh_.triangles.size());
    for (const std::uint32_t t : piece)
    {
      for (const std::uint32_t other : neighbors_[t])
      {
        if (other != None && sides_[other] == sides_[t])
        {
          sets.join(t, other);
        }
      }
    }
    std::map<std::size_t, Part> parts;
    std::array<double, 2> areaOfSide{ 0., 0. };
    for (const std::uint32_t t : piece)
    {
      Part& part = parts[sets.root(t)];
      part.side = sides_[t];
      part.area += areaOf(mesh_, t);
      areaOfSide[sides_[t] > 0 ? 0 : 1] += areaOf(mesh_, t);
      for (std::size_t side = 0; side < 3; ++side)
      {
        if (isSeam(t, side))
        {
          part.seam += (mesh_.points[mesh_.triangles[t][(side + 1) % 3]] -
            mesh_.points[mesh_.triangles[t][side]])
                         .norm();
        }
      }
    }
    const std::int8_t turned = areaOfSide[0] < areaOfSide[1] ? 1 : -1;
    const double least = LeastPart * (areaOfSide[0] + areaOfSide[1]);
    const auto isCutOff = [&](const Part& part)
    {
      return part.side == turned && part.area >= least &&
        part.seam * part.seam < MostSquaredSeam * part.area;
    };
    for (const std::uint32_t t : piece)
    {
      isOff_[t] = isCutOff(parts[sets.root(t)]) ? 1 : 0;
    }
    return std::size_t(std::count_if(
      parts.begin(), parts.end(), [&](const auto& part) { return isCutOff(part.second); }));
  }

  /// The mesh without the triangles at the seams.
  TriangleMesh cut() const
  {
    std::vector<std::uint8_t> isAtSeam(mesh_.points.size(), 0);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (std::size_t side = 0; side < 3; ++side)
      {
        const std::uint32_t other = neighbors_[t][side];
        if (other != None && isOff_[other] != isOff_[t])
        {
          isAtSeam[mesh_.triangles[t][side]] = isAtSeam[mesh_.triangles[t][(side + 1) % 3]] = 1;
        }
      }
    }
    TriangleMesh result{ mesh_.points, {} };
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      auto triangle = mesh_.triangles[t];
      if (std::none_of(triangle.begin(), triangle.end(),
            [&](std::uint32_t corner) { return isAtSeam[corner] != 0; }))
      {
        if (isOff_[t] != 0)
        {
          std::swap(triangle[1], triangle[2]);
        }
        result.triangles.push_back(triangle);
      }
    }
    return result;
  }

private:
  bool isSeam(std::uint32_t triangle, std::size_t side) const
  {
    const std::uint32_t other = neighbors_[triangle][side];
    return other != None && sides_[other] != sides_[triangle];
  }

  const TriangleMesh& mesh_;
  Neighbors neighbors_;
  std::vector<std::int8_t> sides_;
  std::vector<std::uint8_t> isOff_;
};
}

double turnedShare(const TriangleMesh& mesh)
{
  const std::size_t step = std::max<std::size_t>(1, mesh.triangles.size() / TrianglesAsked);
  double turned = 0., all = 0.;
  for (const std::vector<std::uint32_t>& piece : piecesOf(mesh))
  {
    const WindingNumber winding(mesh, piece);
    std::array<double, 2> areaOfSide{ 0., 0. };
    for (std::size_t i = step / 2; i < piece.size(); i += step)
    {
      const double area = areaOf(mesh, piece[i]), number = winding.atTriangle(piece[i]);
      all += area;
      if (std::abs(number) >= double(LeastWinding))
      {
        areaOfSide[number > 0. ? 0 : 1] += area;
      }
    }
    turned += std::min(areaOfSide[0], areaOfSide[1]);
  }
  return all > 0. ? turned / all : 0.;
}

std::size_t separateTurnedParts(TriangleMesh& mesh)
{
  TurnedParts parts(mesh);
  std::vector<float> numbers(mesh.triangles.size(), 0.f);
  std::size_t count = 0;
  for (const std::vector<std::uint32_t>& piece : piecesOf(mesh))
  {
    if (piece.size() < LeastTriangles)
    {
      continue;
    }
    const WindingNumber winding(mesh, piece);
    std::array<double, 2> areaOfSide{ 0., 0. };
    for (const std::uint32_t t : piece)
    {
      numbers[t] = float(winding.atTriangle(t));
      if (std::abs(numbers[t]) >= LeastWinding)
      {
        areaOfSide[numbers[t] > 0.f ? 0 : 1] += areaOf(mesh, t);
      }
    }
    // Where nothing is turned, there is nothing more to do.
    if (std::min(areaOfSide[0], areaOfSide[1]) > LeastPart * (areaOfSide[0] + areaOfSide[1]))
    {
      count += parts.add(piece, numbers);
    }
  }
  if (count > 0)
  {
    mesh = parts.cut();
  }
  return count;
}
}
