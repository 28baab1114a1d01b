// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/ContrarySides.h"
#include "mesh/Mesh.h"
#include "mesh/Pieces.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// What tells which side of a piece is the outer one.
enum class SideEvidence : std::uint8_t
{
  Nothing,
  Neighbors,   ///< a piece near by, whose side is known
  Shadows,     ///< what is hidden from where it looks, see ShadowSides.h
  Density,     ///< how dense the points are, seen from there, see DensitySides.h
  Volume,      ///< what the piece encloses
  Normals,     ///< those of the points
  UpDirection, ///< most of the piece looks upwards
  Viewpoints   ///< it looks to where its points were seen from
};
constexpr std::size_t SideEvidences = 8;

/// "nothing", "neighbours", "shadows", "density", "volume", "normals", "up direction",
/// "viewpoints".
std::string_view name(SideEvidence evidence);

/// What is known of the sides of a piece.
struct Side
{
  SideEvidence evidence = SideEvidence::Nothing;
  bool isTurned = false; ///< whether it is to be turned inside out
  bool isGuess = false;  ///< by the volume of what is hardly bent, see isGuessByVolume()

  bool isKnown() const { return evidence != SideEvidence::Nothing; }
};

/// How the pieces of a mesh came to their sides.
struct OrientationReport
{
  std::size_t pieces = 0;
  std::size_t unknownPieces = 0;
  /// Of the area, by what told its side; they add up to 1 where there is an area.
  std::array<double, SideEvidences> shares{};
  double guessedShare = 0.; ///< of the area, see Side::isGuess and mayBeVessel()
  /// By kind: whether it was given, and told nothing of any piece.
  std::array<bool, SideEvidences> toldNothing{};
  /// Where parts look to opposite sides though they face each other, if they do: see FacingBoundaries.h.
  std::optional<Vector4> contradiction;
  /// Pieces within others, see NestedPieces.h: the part of the area, and a place.
  double nestedShare = 0.;
  Vector4 nested{};
  /// Whether shadows tell that the surface looks inwards, against the volume: see sidesFromWithin().
  bool isFromWithin = false;
  /// Where parts of a piece look away from what has told its side: the views of the points, or the normals.
  ContrarySides contrary;
  /// Whether the views of the points told the sides of almost all of the area: `contrary` is all there is, then.
  bool areViewsKnown = false;

  double share(SideEvidence evidence) const { return shares[std::size_t(evidence)]; }
  bool hasToldNothing(SideEvidence evidence) const { return toldNothing[std::size_t(evidence)]; }
  double unknownShare() const { return share(SideEvidence::Nothing); }
  /// By which most of the area has its side.
  SideEvidence main() const;
};

/// The side that the volume tells. That of a closed piece always does. An open piece has one that
/// depends on how its loops are closed, about as much as F^1.5, where F is the area that closes them,
/// or its own if that is less. So the volume tells where it is more than a 60th of that: objects
/// scanned on a table have 0 to 15, caps of a sphere 20 where they are 20 degrees wide, but terrain
/// and views of flat things more than 180.
Side sideByVolume(const Piece& piece);

/// Whether the volume of a piece makes its side likely at best. A wall with a corner, a street with its houses and a
/// bowl enclose something on their outer side, as they were scanned; half of a sphere has 2.7 of what is 5 here.
bool isGuessByVolume(const Piece& piece);

/// Whether a piece is so wide open that its points may be those of the inside of a vessel, which the volume does not
/// tell from a body scanned on a table. Other evidence than the volume is not better there, but such a side is reported
/// as a guess.
bool mayBeVessel(const Piece& piece);

/// Turns the pieces that are to be turned, and reports by what.
OrientationReport turn(Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides);

/// Turns those pieces inside out whose volume tells that they are, for a mesh may have grown so.
/// Others stay as they are. Returns how many were turned.
std::size_t orientOutwards(Mesh& mesh);
}
