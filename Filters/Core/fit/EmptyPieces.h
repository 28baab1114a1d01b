// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"
#include "mesh/NumberedTriangles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
Vector4 centerOf(const Mesh& mesh, const Triangle& triangle);
/// The normal of a triangle, as long as twice its area.
Vector4 crossOf(const Mesh& mesh, const Triangle& triangle);

/// A connected piece of triangles without samples.
struct EmptyPiece
{
  std::vector<std::uint32_t> triangles;
  double area = 0.;
  double areaAround = 0.; ///< area of the triangles that touch it
  double samplesAround = 0.;
  double areaBeyond = 0.; ///< of the triangles that touch those
  double samplesBeyond = 0.;
  Vector4 normalBeyond; ///< the sum of their normals
  bool isAtBoundary = false;

  double density() const { return areaAround > 0. ? samplesAround / areaAround : 0.; }
  double densityBeyond() const { return areaBeyond > 0. ? samplesBeyond / areaBeyond : 0.; }
};

/// The pieces of those triangles that are not 0 in `isEmpty`, connected by vertices, in the order of their first
/// triangles. `samples` tells of each triangle how many it
/// has.
std::vector<EmptyPiece> findEmptyPieces(const Mesh& mesh, const NumberedTriangles& triangles,
  std::span<const std::uint32_t> samples, std::span<const std::uint8_t> isEmpty,
  const Executor& executor = Executor::sequential());

/// Whether a piece leads around something: it is no disc, by Euler's formula.
bool isTube(const EmptyPiece& piece, const NumberedTriangles& triangles);
}
