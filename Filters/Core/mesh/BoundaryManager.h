// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Mesh.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace neuralmesh
{
class Archive;

/// The boundaries of a mesh, as loops of boundary edges (12.5). They are traced from the whole mesh
/// once, at the start; from then on only what an operation has touched is looked at. The edges of a
/// loop are found in the rings of the mesh: it runs from each boundary vertex to the last one in
/// its ring, with the opening on its left.
class BoundaryManager
{
public:
  using LoopIndex = std::uint32_t;
  static constexpr LoopIndex NoLoop = std::numeric_limits<LoopIndex>::max();

  struct Loop
  {
    VertexIndex first = NoVertex; ///< where it may be entered
    std::uint32_t size = 0;       ///< vertices in it; 0 = there is no such loop any more

    template <typename Archive>
    void exchange(Archive& archive)
    {
      archive(first, size);
    }
  };

  explicit BoundaryManager(const Mesh& mesh);

  /// By their index; gone ones have size 0.
  std::span<const Loop> loops() const { return loops_; }
  std::size_t loopCount() const { return loops_.size() - unused_.size(); }
  /// The loop in which a vertex lies; NoLoop for inner ones.
  LoopIndex loopOf(VertexIndex v) const { return v < loopOf_.size() ? loopOf_[v] : NoLoop; }
  /// The vertices of a loop, in its direction.
  std::vector<VertexIndex> vertices(const Mesh& mesh, LoopIndex loop) const;

  /// `v` was split, and `added` came out of it.
  void split(VertexIndex v, VertexIndex added);
  /// `removed` is about to be collapsed into `kept`.
  void collapse(VertexIndex removed, VertexIndex kept);
  /// Something has changed at these vertices, some of which may be gone: forgets the loops in which
  /// they were, and traces those in which they are.
  void retrace(const Mesh& mesh, std::span<const VertexIndex> changed);
  /// As Mesh::renumber().
  void renumber(std::span<const VertexIndex> permutation);

  /// Writes the boundaries of the mesh, or reads them.
  void exchange(Archive& archive, const Mesh& mesh);

private:
  bool findVertices(const Mesh& mesh);
  void forget(VertexIndex v);
  void trace(const Mesh& mesh, VertexIndex first);

  std::vector<LoopIndex> loopOf_;
  std::vector<Loop> loops_;
  std::vector<LoopIndex> unused_;
};
}
