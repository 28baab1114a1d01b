// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// What is wrong with a surface: see SelfIntersections.h.
struct DefectCount
{
  std::size_t intersectingTriangles = 0;
  std::size_t foldedEdges = 0;

  std::size_t total() const { return this->intersectingTriangles + this->foldedEdges; }
};

struct IntersectionRepair
{
  DefectCount before;
  DefectCount after;
  std::size_t flips = 0;
};

/// Repairs where a finished mesh cuts through itself or is folded: flips folded edges, and smooths
/// what is left, where it stays broken for long in a growing neighbourhood. Where the surface cuts through another part
/// of itself, both move apart.
///
/// Only vertices near defects move, and a mesh without any stays as it is. Vertices, pieces,
/// handles and boundaries stay what they are; triangles change in number only if ... .
/// After some rounds it gives up, with the fewest defects it came by: sheets that interpenetrate
/// widely may stay so. The same mesh gives the same result on every machine.
IntersectionRepair repairIntersections(Mesh& mesh);
}
