// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Orientation.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// F^1.5 over the volume.
constexpr double FlattestThatTells = 60.;
constexpr double FlattestThatIsCertain = 5.;
/// Of the area of a piece, what closes the loops of a body that is not taken for a vessel.
constexpr double WidestOfBodies = 0.1;

/// How wrong the volume may be.
double uncertaintyOfVolume(const Piece& piece)
{
  return piece.isClosed ? 0. : std::pow(std::min(piece.area, piece.closingArea), 1.5);
}
}

std::string_view name(SideEvidence evidence)
{
  constexpr std::array<std::string_view, SideEvidences> names{ "nothing", "neighbours", "shadows",
    "density", "volume", "normals", "up direction", "viewpoints" };
  return names[std::size_t(evidence)];
}

SideEvidence OrientationReport::main() const
{
  return SideEvidence(std::max_element(shares.begin(), shares.end()) - shares.begin());
}

Side sideByVolume(const Piece& piece)
{
  const double volume = std::abs(piece.volume);
  // A volume of 0 tells nothing, nor does one that is not finite.
  return volume > 0. && uncertaintyOfVolume(piece) <= FlattestThatTells * volume
    ? Side{ SideEvidence::Volume, piece.volume < 0., isGuessByVolume(piece) }
    : Side{};
}

bool isGuessByVolume(const Piece& piece)
{
  return uncertaintyOfVolume(piece) > FlattestThatIsCertain * std::abs(piece.volume);
}

bool mayBeVessel(const Piece& piece)
{
  return !piece.isClosed && piece.closingArea > WidestOfBodies * piece.area;
}

OrientationReport turn(Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides)
{
  OrientationReport report;
  report.pieces = pieces.size();
  double area = 0.;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (sides[i].isTurned)
    {
      mesh.reverseOrientation(pieces[i].vertices);
    }
    report.unknownPieces += sides[i].isKnown() ? 0 : 1;
    report.shares[std::size_t(sides[i].evidence)] += pieces[i].area;
    const bool isGuess =
      sides[i].isGuess || (sides[i].evidence == SideEvidence::Volume && mayBeVessel(pieces[i]));
    report.guessedShare += isGuess ? pieces[i].area : 0.;
    area += pieces[i].area;
  }
  for (double& share : report.shares)
  {
    share = area > 0. ? share / area : 0.;
  }
  report.guessedShare = area > 0. ? report.guessedShare / area : 0.;
  return report;
}

std::size_t orientOutwards(Mesh& mesh)
{
  const std::vector<Piece> pieces = findPieces(mesh);
  std::vector<Side> sides(pieces.size());
  std::transform(pieces.begin(), pieces.end(), sides.begin(), sideByVolume);
  turn(mesh, pieces, sides);
  return std::size_t(
    std::count_if(sides.begin(), sides.end(), [](const Side& side) { return side.isTurned; }));
}
}
