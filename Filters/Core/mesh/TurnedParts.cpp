// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TurnedParts.h"

#include "base/DisjointSets.h"
#include "mesh/LeastCut.h"
#include "mesh/WindingNumber.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A triangle has a side beyond that winding number, see WindingNumber::atTriangle().
constexpr double LeastWinding = 0.35;
/// What bounds a body has 1/2 at most, unless what is missing of it hides the body from itself. A part that hangs on
/// to a table by the wrong side has more: the table is seen from its front there, as the part is from within.
constexpr double MostWinding = 0.6;
/// So large a part of its piece is one.
constexpr double LeastTurnedPart = 0.03;
/// The same of those that have more than MostWinding. Hardly anything else has.
constexpr double LeastPartBeyond = 0.01;
/// What a part hangs by is narrow if the square of its length is less than that many of its areas; more of what
/// is closed but for that.
constexpr double MostSquaredSeam = 0.25;
constexpr double MostSquaredSeamIfClosed = 1.;
/// ... and so many for the boundary loops that it touches. The outline of a sheet is longer: its ends may roll up
/// to either side.
constexpr double MostSquaredLoops = 10.;
/// Where a piece has so many handles it is no sheet, whatever its outline.
constexpr long HandlesOfNoSheet = 2;
/// The winding number of what is closed, on average.
constexpr double WindingIfClosed = 0.45;
/// A piece with fewer triangles has no parts.
constexpr std::size_t LeastTrianglesOfPiece = 100;
/// Of each piece, whether anything is turned.
constexpr std::size_t TrianglesAsked = 500;

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
  std::vector<std::uint32_t> pieceOf(mesh.points.size(), NoTriangle);
  std::vector<std::vector<std::uint32_t>> pieces;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
  {
    std::uint32_t& piece = pieceOf[sets.root(mesh.triangles[t][0])];
    if (piece == NoTriangle)
    {
      piece = std::uint32_t(pieces.size());
      pieces.emplace_back();
    }
    pieces[piece].push_back(t);
  }
  return pieces;
}

/// The area of a piece that shows either side, of some triangles.
struct SidesShown
{
  double outer = 0.;
  double inner = 0.;
  double beyond = 0.; ///< that has more than MostWinding
  double asked = 0.;

  bool areBothShown() const { return std::min(outer, inner) > LeastTurnedPart * asked; }
  bool isAnyBeyond() const { return beyond > LeastPartBeyond * asked; }
};

SidesShown sidesShown(const TriangleMesh& mesh, const std::vector<std::uint32_t>& piece,
  const WindingNumber& winding, std::size_t step)
{
  SidesShown result;
  for (std::size_t i = std::min(step / 2, piece.size() - 1); i < piece.size(); i += step)
  {
    const double area = areaOf(mesh, piece[i]), number = winding.atTriangle(piece[i]);
    result.asked += area;
    result.outer += number >= LeastWinding ? area : 0.;
    result.inner += number <= -LeastWinding ? area : 0.;
    result.beyond += std::abs(number) >= MostWinding ? area : 0.;
  }
  return result;
}

/// The boundary loops of a mesh, each with its length.
class BoundaryLengths
{
public:
  BoundaryLengths(const TriangleMesh& mesh, const TriangleNeighbors& neighbors)
    : loops_(mesh.points.size())
    , lengths_(mesh.points.size(), 0.)
    , isBoundary_(mesh.points.size(), 0)
  {
    const auto forEachEdge = [&](const auto& use)
    {
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      {
        for (std::size_t side = 0; side < 3; ++side)
        {
          if (neighbors[t][side] == NoTriangle)
          {
            use(mesh.triangles[t][side], mesh.triangles[t][(side + 1) % 3]);
          }
        }
      }
    };
    forEachEdge(
      [&](std::uint32_t from, std::uint32_t to)
      {
        loops_.join(from, to);
        isBoundary_[from] = isBoundary_[to] = 1;
      });
    forEachEdge([&](std::uint32_t from, std::uint32_t to)
      { lengths_[loops_.root(from)] += (mesh.points[to] - mesh.points[from]).norm(); });
  }

  bool has(std::uint32_t point) const { return isBoundary_[point] != 0; }
  std::size_t loopAt(std::uint32_t point) { return loops_.root(point); }
  double length(std::size_t loop) const { return lengths_[loop]; }

private:
  DisjointSets loops_;
  std::vector<double> lengths_;
  std::vector<std::uint8_t> isBoundary_;
};

/// A part of a piece that shows one side.
struct Part
{
  double area = 0.;
  double winding = 0.;    ///< the size of the winding number, times the area
  double seam = 0.;       ///< length of the edges to parts that show the other side
  double loopLength = 0.; ///< of the boundary loops that these touch
  std::set<std::size_t> loops;
  std::int8_t side = 0;

  bool isOfSheet() const { return loopLength * loopLength >= MostSquaredLoops * area; }
  bool hangsByLittle() const
  {
    const bool isClosed = winding >= WindingIfClosed * area;
    return !isOfSheet() &&
      seam * seam < (isClosed ? MostSquaredSeamIfClosed : MostSquaredSeam) * area;
  }
};

/// What tells a part from the rest of its piece.
enum class Sign
{
  Side,  ///< it shows the side that less of the piece does
  Beyond ///< see MostWinding
};

/// Parts of all pieces that are to be cut off.
class TurnedParts
{
public:
  explicit TurnedParts(const TriangleMesh& mesh)
    : mesh_(mesh)
    , neighbors_(neighborsIn(mesh))
    , boundaries_(mesh, neighbors_)
    , sides_(mesh.triangles.size(), 0)
    , isOff_(mesh.triangles.size(), 0)
    , numbers_(mesh.triangles.size(), 0.)
  {
  }

  /// Returns how many there are in a piece.
  std::size_t add(const std::vector<std::uint32_t>& piece, const WindingNumber& winding, Sign sign)
  {
    for (const std::uint32_t t : piece)
    {
      numbers_[t] = winding.atTriangle(t);
      sides_[t] = sign == Sign::Side ? sideShown(numbers_[t]) : sideOfBeyond(numbers_[t]);
    }
    // What tells nothing, as a table does, belongs to either: what stands on it is cut off where it is narrow.
    divideByLeastCut(mesh_, neighbors_, piece, sides_);
    DisjointSets sets(mesh_.triangles.size());
    for (const std::uint32_t t : piece)
    {
      for (const std::uint32_t other : neighbors_[t])
      {
        if (other != NoTriangle && sides_[other] == sides_[t])
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
      part.winding += std::abs(numbers_[t]) * areaOf(mesh_, t);
      areaOfSide[sides_[t] > 0 ? 0 : 1] += areaOf(mesh_, t);
      for (std::size_t side = 0; side < 3; ++side)
      {
        if (isSeam(t, side))
        {
          addSeam(part, mesh_.triangles[t][side], mesh_.triangles[t][(side + 1) % 3]);
        }
      }
    }
    const bool isLess = areaOfSide[0] < areaOfSide[1];
    const std::int8_t turned = sign == Sign::Beyond || isLess ? 1 : -1;
    const double least =
      (sign == Sign::Side ? LeastTurnedPart : LeastPartBeyond) * (areaOfSide[0] + areaOfSide[1]);
    const double leastWinding = sign == Sign::Side ? 0. : MostWinding;
    const auto isTurned = [&](const Part& part) {
      return part.side == turned && part.area >= least && part.winding >= leastWinding * part.area;
    };
    const auto isCutOff = [&](const Part& part) { return isTurned(part) && part.hangsByLittle(); };
    const bool isNoSheet = handlesOf(piece) >= HandlesOfNoSheet;
    for (const auto& [root, part] : parts)
    {
      turnedArea_ += isTurned(part) && (isNoSheet || !part.isOfSheet()) ? part.area : 0.;
    }
    for (const std::uint32_t t : piece)
    {
      isOff_[t] = isCutOff(parts[sets.root(t)]) ? 1 : 0;
    }
    return std::size_t(std::count_if(
      parts.begin(), parts.end(), [&](const auto& part) { return isCutOff(part.second); }));
  }

  /// Of what has been added, cut off or not; but for parts of sheets.
  double turnedArea() const { return turnedArea_; }

  /// The mesh without the triangles at the seams.
  TriangleMesh cut() const
  {
    std::vector<std::uint8_t> isAtSeam(mesh_.points.size(), 0);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    {
      for (std::size_t side = 0; side < 3; ++side)
      {
        const std::uint32_t other = neighbors_[t][side];
        if (other != NoTriangle && isOff_[other] != isOff_[t])
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
  static std::int8_t sideShown(double number)
  {
    return std::int8_t(number >= LeastWinding ? 1 : number <= -LeastWinding ? -1 : 0);
  }

  static std::int8_t sideOfBeyond(double number)
  {
    const double size = std::abs(number);
    return std::int8_t(size >= MostWinding ? 1 : size < LeastWinding ? -1 : 0);
  }

  bool isSeam(std::uint32_t triangle, std::size_t side) const
  {
    const std::uint32_t other = neighbors_[triangle][side];
    return other != NoTriangle && sides_[other] != sides_[triangle];
  }

  long handlesOf(const std::vector<std::uint32_t>& piece)
  {
    std::set<std::uint32_t> points;
    std::set<std::size_t> loops;
    long sides = 0;
    for (const std::uint32_t t : piece)
    {
      for (std::size_t side = 0; side < 3; ++side)
      {
        const std::uint32_t point = mesh_.triangles[t][side];
        points.insert(point);
        sides += neighbors_[t][side] == NoTriangle ? 2 : 1;
        if (boundaries_.has(point))
        {
          loops.insert(boundaries_.loopAt(point));
        }
      }
    }
    const long euler = long(points.size()) - sides / 2 + long(piece.size());
    return (2 - long(loops.size()) - euler) / 2;
  }

  void addSeam(Part& part, std::uint32_t from, std::uint32_t to)
  {
    part.seam += (mesh_.points[to] - mesh_.points[from]).norm();
    for (const std::uint32_t point : { from, to })
    {
      if (boundaries_.has(point) && part.loops.insert(boundaries_.loopAt(point)).second)
      {
        part.loopLength += boundaries_.length(boundaries_.loopAt(point));
      }
    }
  }

  const TriangleMesh& mesh_;
  TriangleNeighbors neighbors_;
  BoundaryLengths boundaries_;
  std::vector<std::int8_t> sides_;
  std::vector<std::uint8_t> isOff_;
  std::vector<double> numbers_; ///< see WindingNumber::atTriangle()
  double turnedArea_ = 0.;
};

/// Adds the parts of those pieces that show both sides. Returns how many are to be cut off.
std::size_t addParts(const TriangleMesh& mesh, std::optional<TurnedParts>& parts)
{
  std::size_t count = 0;
  for (const std::vector<std::uint32_t>& piece : piecesOf(mesh))
  {
    if (piece.size() < LeastTrianglesOfPiece)
    {
      continue;
    }
    // Where nothing is turned, there is nothing more to do.
    const WindingNumber winding(mesh, piece);
    const std::size_t step = std::max<std::size_t>(1, piece.size() / TrianglesAsked);
    const SidesShown sides = sidesShown(mesh, piece, winding, step);
    if (sides.areBothShown() || sides.isAnyBeyond())
    {
      if (!parts)
      {
        parts.emplace(mesh);
      }
      count += parts->add(piece, winding, sides.areBothShown() ? Sign::Side : Sign::Beyond);
    }
  }
  return count;
}
}

double turnedShare(const TriangleMesh& mesh)
{
  std::optional<TurnedParts> parts;
  addParts(mesh, parts);
  double area = 0.;
  for (std::uint32_t t = 0; parts && t < mesh.triangles.size(); ++t)
  {
    area += areaOf(mesh, t);
  }
  return area > 0. ? parts->turnedArea() / area : 0.;
}

std::size_t separateTurnedParts(TriangleMesh& mesh)
{
  std::optional<TurnedParts> parts;
  const std::size_t count = addParts(mesh, parts);
  if (count > 0)
  {
    mesh = parts->cut();
  }
  return count;
}
}
