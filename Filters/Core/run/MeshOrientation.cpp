// SPDX-License-Identifier: BSD-3-Clause
#include "run/MeshOrientation.h"

#include "cloud/DensitySides.h"
#include "cloud/OrientationVote.h"
#include "cloud/PieceAgreement.h"
#include "cloud/ShadowSides.h"
#include "mesh/FacingBoundaries.h"
#include "mesh/OpeningSides.h"
#include "mesh/Relief.h"
#include "run/NestedPieces.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the largest volume: an open piece of less may be torn off another one, and bulge inwards.
constexpr double LeastVolume = 0.1;
/// Of the angle between what looks up or down and z.
constexpr double CosineOfGround = 0.9;
/// Of the area of a piece, projected onto the ground: with less it is upright, and has no upper side.
constexpr double LeastUpwards = 0.05;
/// Of the area: pieces that follow neighbours, but contradict most of what is around them.
constexpr double MostInDoubt = 0.01;
/// Less may be small pieces to which no view came.
constexpr double LeastShareSeen = 0.95;

/// What of a piece looks up, less what looks down, of its area: of what is nearly level, and of all as far as it
/// does.
struct Upwards
{
  double ground = 0.;
  double all = 0.;
};

std::vector<Upwards> upwardsOf(const Mesh& mesh, std::span<const Piece> pieces)
{
  std::vector<std::uint32_t> pieceOf(mesh.indexEnd());
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      pieceOf[v] = i;
    }
  }
  std::vector<Upwards> result(pieces.size());
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Vector4 normal =
        cross(mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a));
      const double z = double(normal[2]), length = std::sqrt(double(squaredNorm(normal)));
      const double area = std::max(pieces[pieceOf[a]].area, std::numeric_limits<double>::min());
      Upwards& piece = result[pieceOf[a]];
      piece.all += 0.5 * z / area;
      piece.ground += std::abs(z) > CosineOfGround * length ? 0.5 * z / area : 0.;
    });
  return result;
}

/// The area of each piece that is level and looks up, less that which looks down.
std::vector<double> groundOf(std::span<const Piece> pieces, const std::vector<Upwards>& upwards)
{
  std::vector<double> result(pieces.size());
  std::transform(pieces.begin(), pieces.end(), upwards.begin(), result.begin(),
    [](const Piece& piece, const Upwards& up) { return up.ground * piece.area; });
  return result;
}

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

/// Which of these sides are more than a guess.
std::vector<Side> certainOf(std::vector<Side> sides)
{
  std::replace_if(
    sides.begin(), sides.end(), [](const Side& side) { return side.isGuess; }, Side());
  return sides;
}

/// What those that are known tell of others near by.
std::vector<Side> sidesByNeighbors(const Mesh& mesh, std::span<const Piece> pieces,
  const std::vector<Side>& sides, const std::vector<double>& ground)
{
  std::vector<Side> result = sides;
  makePiecesAgree(mesh, pieces, result, ground);
  std::replace_if(
    result.begin(), result.end(), [](const Side& side) { return !side.isKnown(); }, Side());
  return result;
}

/// Without the guesses that have a ground look down: the volume of streets and tables is that of what stands on them,
/// or of what is dug into them.
std::vector<Side> withoutGroundAbove(std::vector<Side> sides, const std::vector<Upwards>& upwards)
{
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const double ground = sides[i].isTurned ? -upwards[i].ground : upwards[i].ground;
    if (sides[i].isGuess && ground <= -LeastGround)
    {
      sides[i] = {};
    }
  }
  return sides;
}

/// Has what is unknown look to what stands on it, or up, as most of what is scanned from above does.
void turnUp(const std::vector<Side>& byStanding, const std::vector<Upwards>& upwards,
  std::vector<Side>& sides)
{
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    if (!sides[i].isKnown())
    {
      sides[i].isTurned =
        byStanding[i].isKnown() ? byStanding[i].isTurned : upwards[i].all < -LeastUpwards;
    }
  }
}

bool areAllKnown(const std::vector<Side>& sides)
{
  return std::all_of(sides.begin(), sides.end(), [](const Side& side) { return side.isKnown(); });
}

/// The votes of each vertex by what has told the side of its piece, after that has been turned. None where something
/// else has.
std::vector<float> votesOf(const Mesh& mesh, std::span<const Piece> pieces,
  const std::vector<Side>& sides, const VotedSides& byViewpoints, const VotedSides& byNormals)
{
  std::vector<float> votes(mesh.indexEnd(), 0.f);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const bool isByViewpoints = sides[i].evidence == SideEvidence::Viewpoints;
    if (isByViewpoints || sides[i].evidence == SideEvidence::Normals)
    {
      const std::vector<float>& voted = isByViewpoints ? byViewpoints.votes : byNormals.votes;
      for (const VertexIndex v : pieces[i].vertices)
      {
        votes[v] = voted.empty() ? 0.f : sides[i].isTurned ? -voted[v] : voted[v];
      }
    }
  }
  return votes;
}

/// Where pieces whose neighbours told their side contradict others that they face, along much of their boundaries, if
/// they are more than a little of the area: they follow one neighbour, and others say the contrary.
std::optional<Vector4> placeInDoubt(const Mesh& mesh, std::span<const Piece> pieces,
  const std::vector<Side>& sides, const std::vector<FacingPair>& pairs)
{
  std::vector<std::uint32_t> pieceOf(mesh.indexEnd());
  double area = 0.;
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
  {
    area += pieces[i].area;
    for (const VertexIndex v : pieces[i].vertices)
    {
      pieceOf[v] = i;
    }
  }
  std::vector<FacingBoundaries> around(pieces.size());
  for (const FacingPair& pair : pairs)
  {
    const std::uint32_t one = pieceOf[pair.vertex], other = pieceOf[pair.other];
    for (const std::uint32_t piece : { one, other })
    {
      FacingBoundaries& ofPiece = around[piece];
      if (one != other)
      {
        (pair.contradict ? ofPiece.contradicting : ofPiece.agreeing) += pair.length;
        ofPiece.place = pair.contradict ? mesh.position(pair.vertex) : ofPiece.place;
      }
    }
  }
  double inDoubt = 0., largest = 0.;
  Vector4 place;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const FacingBoundaries& facing = around[i];
    if (sides[i].evidence == SideEvidence::Neighbors && facing.doContradict(pieces[i].area) &&
      facing.contradicting > facing.agreeing)
    {
      inDoubt += pieces[i].area;
      place = pieces[i].area > largest ? facing.place : place;
      largest = std::max(largest, pieces[i].area);
    }
  }
  return inDoubt > MostInDoubt * area ? std::optional(place) : std::nullopt;
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
  const std::vector<Piece> pieces = findPieces(mesh, executor);
  const OrientationVote vote(mesh, pieces, cloud, hints, executor);
  std::vector<Side> sides(pieces.size()), byVolume(pieces.size());
  const VotedSides byViewpoints = hints.viewpoints.empty() ? VotedSides() : vote.byViewpoints();
  const VotedSides byNormals = hints.normalOf ? vote.byNormals() : VotedSides();
  const bool areViewpointsMute = !hints.viewpoints.empty() && addSides(byViewpoints.sides, sides);
  const bool isUpMute = hints.up && addSides(vote.byUpDirection(), sides);
  const bool areNormalsMute = hints.normalOf && addSides(byNormals.sides, sides);
  const bool isHinted =
    std::any_of(sides.begin(), sides.end(), [](const Side& side) { return side.isKnown(); });
  std::transform(pieces.begin(), pieces.end(), byVolume.begin(), sideByVolume);
  const std::vector<Side> ofBodies = sidesOfBodies(pieces, byVolume);
  addSides(certainOf(ofBodies), sides);
  bool isFromWithin = false, isByDensity = false;
  if (!isHinted)
  {
    std::vector<Side> byDensity = sidesByDensity(mesh, pieces, sides, cloud, executor);
    isByDensity = !addSides(byDensity, sides);
    addSides(sides, byDensity);
    sides = std::move(byDensity);
  }
  if (!isHinted && !isByDensity)
  {
    FromWithin within = sidesFromWithin(mesh, pieces, sides, cloud, executor);
    isFromWithin = within.isInDoubt;
    addSides(sides, within.sides);
    sides = std::move(within.sides);
  }
  addSides(sidesByOpenings(mesh, pieces, sides), sides);
  if (!isHinted && !isByDensity)
  {
    addSides(sidesByShadows(mesh, pieces, sides, cloud, executor), sides);
  }
  if (!areAllKnown(sides))
  {
    const std::vector<Upwards> upwards = upwardsOf(mesh, pieces);
    // What is given counts more than that.
    const std::vector<double> ground = isHinted ? std::vector<double>() : groundOf(pieces, upwards);
    addSides(sidesByNeighbors(mesh, pieces, sides, ground), sides);
    addSides(withoutGroundAbove(ofBodies, upwards), sides);
    addSides(sidesByOpenings(mesh, pieces, sides), sides);
    addSides(sidesByNeighbors(mesh, pieces, sides, ground), sides);
    addSides(withoutGroundAbove(byVolume, upwards), sides);
    addSides(withoutGroundAbove(sidesByRelief(mesh, pieces, sides), upwards), sides);
    turnUp(sidesByStanding(mesh, pieces, sides), upwards, sides);
    makePiecesAgree(mesh, pieces, sides, ground);
  }
  OrientationReport report = turn(mesh, pieces, sides);
  const std::vector<FacingPair> pairs = facingPairs(mesh);
  const FacingBoundaries facing = findFacingBoundaries(mesh, pairs);
  report.contradiction = facing.doContradict(areaOf(mesh, executor))
    ? std::optional(facing.place)
    : placeInDoubt(mesh, pieces, sides, pairs);
  const NestedPieces nested = findNestedPieces(mesh, pieces, sides);
  report.nestedShare = nested.share;
  report.nested = nested.place;
  report.isFromWithin = isFromWithin;
  if (!byViewpoints.votes.empty() || !byNormals.votes.empty())
  {
    report.contrary =
      findContrarySides(mesh, votesOf(mesh, pieces, sides, byViewpoints, byNormals), executor);
  }
  report.areViewsKnown =
    !byViewpoints.votes.empty() && report.share(SideEvidence::Viewpoints) >= LeastShareSeen;
  report.toldNothing[std::size_t(SideEvidence::Viewpoints)] = areViewpointsMute;
  report.toldNothing[std::size_t(SideEvidence::UpDirection)] = isUpMute;
  report.toldNothing[std::size_t(SideEvidence::Normals)] = areNormalsMute;
  return report;
}
}
