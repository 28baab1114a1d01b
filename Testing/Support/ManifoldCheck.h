// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace neuralmesh::testing
{
/// What a set of triangles is, found from the triangles alone.
struct ManifoldReport
{
  std::size_t usedPoints = 0;
  std::size_t unusedPoints = 0;
  std::size_t boundaryEdges = 0;
  std::size_t boundaryLoops = 0; ///< only meaningful if there is no defect
  std::size_t components = 0;
  long eulerCharacteristic = 0; ///< vertices - edges + triangles

  /// The first defect found (an edge of more than two triangles or run along twice in the same
  /// direction, a vertex whose triangles are not one fan, a triangle with a point twice, an index
  /// out of range), in words; empty for an oriented 2-manifold.
  std::string defect;

  bool isClosed() const { return this->boundaryEdges == 0; }
  /// Handles, summed over components, with the holes taken as capped.
  long genus() const
  {
    return long(this->components) - (this->eulerCharacteristic + long(this->boundaryLoops)) / 2;
  }
};

ManifoldReport checkManifold(
  std::size_t pointCount, std::span<const std::array<std::uint32_t, 3>> triangles);
}
