// SPDX-License-Identifier: BSD-3-Clause
#include "run/MeshOrientation.h"

#include "cloud/OrientationVote.h"
#include "cloud/PieceAgreement.h"
#include "mesh/FacingBoundaries.h"
#include "mesh/OpeningSides.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace neuralmesh
{
namespace
{
/// Of the largest volume: an open piece of less may be torn off another one, and bulge inwards.
constexpr double LeastVolume = 0.1;

/// By the volume of what is closed or large.
std::vector<Side> sidesOfBodies(std::span<const Piece> pieces, const std::vector<Side>& byVolume)
{
  double largest = 0.;
  for (const Piece& piece : pieces)
  {
    largest = std::max(largest, std::abs(piece.volume));
  }
  std::vector<Side> sides = byVolume;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (!pieces[i].isClosed && std::abs(pieces[i].volume) < LeastVolume * largest)
    {
      sides[i] = {};
    }
  }
  return sides;
}

/// What those that are known tell of others near by.
std::vector<Side> sidesByNeighbors(
  const Mesh& mesh, std::span<const Piece> pieces, const std::vector<Side>& sides)
{
  std::vector<Side> result = sides;
  makePiecesAgree(mesh, pieces, result);
  std::replace_if(
    result.begin(), result.end(), [](const Side& side) { return !side.isKnown(); }, Side());
  return result;
}

/// Fills in what is not known yet. Returns whether `more` has told nothing.
bool addSides(const std::vector<Side>& more, std::vector<Side>& sides)
{
  std::transform(sides.begin(), sides.end(), more.begin(), sides.begin(),
    [](const Side& known, const Side& other) { return known.isKnown() ? known : other; });
  return std::none_of(more.begin(), more.end(), [](const Side& side) { return side.isKnown(); });
}
}

OrientationReport orientMesh(
  Mesh& mesh, const PointCloud& cloud, const OrientationHints& hints, const Executor& executor)
{
  const std::vector<Piece> pieces = findPieces(mesh);
  const OrientationVote vote(mesh, pieces, cloud, hints, executor);
  std::vector<Side> sides(pieces.size()), byVolume(pieces.size());
  const bool areViewpointsMute = !hints.viewpoints.empty() && addSides(vote.byViewpoints(), sides);
  const bool isUpMute = hints.up && addSides(vote.byUpDirection(), sides);
  const bool areNormalsMute = hints.normalOf && addSides(vote.byNormals(), sides);
  std::transform(pieces.begin(), pieces.end(), byVolume.begin(), sideByVolume);
  addSides(sidesOfBodies(pieces, byVolume), sides);
  addSides(sidesByOpenings(mesh, pieces, sides), sides);
  addSides(sidesByNeighbors(mesh, pieces, sides), sides);
  addSides(byVolume, sides);
  makePiecesAgree(mesh, pieces, sides);
  OrientationReport report = turn(mesh, pieces, sides);
  const FacingBoundaries facing = findFacingBoundaries(mesh);
  if (facing.doContradict(areaOf(mesh)))
  {
    report.contradiction = facing.place;
  }
  report.toldNothing[std::size_t(SideEvidence::Viewpoints)] = areViewpointsMute;
  report.toldNothing[std::size_t(SideEvidence::UpDirection)] = isUpMute;
  report.toldNothing[std::size_t(SideEvidence::Normals)] = areNormalsMute;
  return report;
}
}
