// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The rings of a mesh one behind the other, to be read alone: 29 bytes a vertex in place of 64.
class CompactRings
{
public:
  explicit CompactRings(const Mesh& mesh, const Executor& executor = Executor::sequential());

  /// The number of vertices.
  std::size_t size() const { return isOpen_.size(); }
  /// Where the ring of a vertex begins among the neighbours of all.
  std::uint32_t begin(VertexIndex v) const { return begin_[v]; }
  std::span<const VertexIndex> operator[](VertexIndex v) const
  {
    return { neighbors_.data() + begin_[v], neighbors_.data() + begin_[v + std::size_t(1)] };
  }
  bool isOpen(VertexIndex v) const { return isOpen_[v] != 0; }
  bool isBoundaryEdge(VertexIndex a, VertexIndex b) const
  {
    return isOpen(a) && ((*this)[a].front() == b || (*this)[a].back() == b);
  }
  /// Of all vertices.
  std::size_t neighborCount() const { return neighbors_.size(); }

private:
  std::vector<std::uint32_t> begin_; ///< and where the last one ends
  ZeroedArray<VertexIndex> neighbors_;
  std::vector<std::uint8_t> isOpen_;
};

/// While it lives, a mesh has no rings: they are compact alone. Restored without allocating anything.
class RingsReleased
{
public:
  RingsReleased(Mesh& mesh, const CompactRings& rings, const Executor& executor)
    : mesh_(mesh)
    , rings_(rings)
    , executor_(executor.uninterrupted())
  {
    mesh_.releaseRings();
  }
  ~RingsReleased() { mesh_.restoreRings(rings_, executor_); }
  RingsReleased(const RingsReleased&) = delete;
  RingsReleased& operator=(const RingsReleased&) = delete;

private:
  Mesh& mesh_;
  const CompactRings& rings_;
  const Executor& executor_;
};
}
