// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace neuralmesh
{
/// All that hangs together by edges.
struct Piece
{
  std::vector<VertexIndex> vertices; ///< each behind one of its neighbours
  bool isClosed = true;
  double area = 0.;
  /// What it encloses where each boundary loop is closed by a fan of triangles to its centroid;
  /// positive if the normals point outwards.
  double volume = 0.;
  double closingArea = 0.; ///< of these fans
};

/// The pieces of a mesh, in the order of their lowest vertices.
std::vector<Piece> findPieces(const Mesh& mesh, const Executor& executor = Executor::sequential());

/// The bounding box of each.
std::vector<Eigen::AlignedBox3d> boxesOf(const Mesh& mesh, std::span<const Piece> pieces);

double areaOf(const Mesh& mesh, const Triangle& triangle);
/// Of all triangles.
double areaOf(const Mesh& mesh, const Executor& executor = Executor::sequential());

std::size_t pieceCount(const Mesh& mesh, const Executor& executor = Executor::sequential());
/// Handles of all pieces together.
long genusOf(const Mesh& mesh, const Executor& executor = Executor::sequential());
}
