// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"
#include "mesh/Pieces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The triangles of all pieces of a mesh, connected by edges, that have less than 2 % of the
/// vertices of the largest one: what is left over where a mesh was cut.
std::vector<Triangle> findSmallPieces(const Mesh& mesh);
/// Of these, the pieces in which a vertex has another valence than before the cut: others were there before.
std::vector<Triangle> findCutOffPieces(
  const Mesh& mesh, std::span<const std::uint8_t> valencesBefore);
/// By the index of the vertex.
std::vector<std::uint8_t> valencesOf(const Mesh& mesh);

/// All pieces with less than these parts of the area and of the vertices of all, but the largest; none where pieces
/// with less than 1 % of the area are most of the mesh.
std::vector<Piece> findOddPieces(const Mesh& mesh, double leastArea, double leastVertices,
  const Executor& executor = Executor::sequential());
/// No vertex may be erased, and none is in the end; properties follow.
void dropPieces(Mesh& mesh, const std::vector<Piece>& pieces);
/// Drops the odd ones. Returns how many.
std::size_t dropPieces(Mesh& mesh, double leastArea, double leastVertices,
  const Executor& executor = Executor::sequential());

/// Drops scraps: open pieces of at most three triangles that lie so close to another piece that this is where their
/// points belong. No vertex may be erased, and none is in the end. Returns how many were dropped.
std::size_t dropScraps(Mesh& mesh, const Executor& executor = Executor::sequential());
}
