// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/DisjointSets.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Tells which boundary loops may be the two mouths of a bore, once gaps are taken out of a mesh. Sheets back to back
/// have rims as near to each other, but there one gap lies between both: to join them would put it back. Where the
/// surface goes on from one loop to the other, as on a pipe that lacks a band, it is put back all the same.
class GapRims
{
public:
  /// `triangles` are those of the gaps; the mesh, which must outlive this, has the same vertices with and without them.
  GapRims(const Mesh& mesh, std::span<const Triangle> triangles);

  bool mayJoin(std::span<const VertexIndex> one, std::span<const VertexIndex> other);

private:
  std::optional<std::size_t> mainGap(std::span<const VertexIndex> loop);
  bool continues(std::span<const VertexIndex> one, std::span<const VertexIndex> other) const;

  const Mesh& mesh_;
  DisjointSets gaps_; ///< of vertices
  std::vector<std::uint8_t> isAtGap_;
};
}
