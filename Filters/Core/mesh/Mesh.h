// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LargePageAllocator.h"
#include "base/Vector4.h"
#include "mesh/Ring.h"
#include "mesh/VertexProperties.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace neuralmesh
{
class Archive;
class CompactRings;
class Executor;

using Triangle = std::array<VertexIndex, 3>;

/// The Neural Mesh M: an oriented triangle 2-manifold, with or without boundary, as the rings of
/// its vertices. 80 bytes a vertex: a ring of 64 and a position of 16. Triangles are implied: each
/// is found in the rings of its three corners.
///
/// Every operation keeps the manifold; what would break it, or lift a valence above Ring::Capacity,
/// is refused by the `can` functions. They must be asked first; any index below indexEnd() will do.
///
/// Indices stay valid until renumber(); those of erased vertices are used again for new ones, but
/// only after releaseErased(), so that nobody takes the one for the other in between.
class Mesh
{
public:
  Mesh() = default;
  /// Vertices of these positions and rings, which must be those of an oriented 2-manifold.
  Mesh(LargeVector<Vector4> positions, LargeVector<Ring> rings);

  /// A regular tetrahedron, outwards oriented.
  static Mesh tetrahedron(Vector4 center, float radius);

  /// The number of vertices.
  std::size_t vertexCount() const { return vertexCount_; }
  /// One more than the highest index in use; erased vertices below it have no neighbours.
  std::size_t indexEnd() const { return rings_.size(); }
  bool isAlive(VertexIndex v) const { return !rings_[v].isEmpty(); }

  Vector4 position(VertexIndex v) const { return positions_[v]; }
  void setPosition(VertexIndex v, Vector4 position) { positions_[v] = position; }
  std::span<const Vector4> positions() const { return positions_; }
  /// To move all of them.
  std::span<Vector4> movablePositions() { return positions_; }

  const Ring& ring(VertexIndex v) const { return rings_[v]; }
  unsigned valence(VertexIndex v) const { return rings_[v].size(); }
  bool isBoundary(VertexIndex v) const { return rings_[v].isOpen(); }
  bool isBoundaryEdge(VertexIndex a, VertexIndex b) const;
  /// How far the valence is from that of a regular vertex: 6, or 4 on a boundary.
  int valenceExcess(VertexIndex v) const { return int(valence(v)) - (isBoundary(v) ? 4 : 6); }

  /// Area-weighted normal at `v`, not normalised.
  Vector4 normal(VertexIndex v) const;

  /// Calls `use(a, b, c)` for every triangle, once.
  template <typename Use>
  void forEachTriangle(Use use) const
  {
    for (VertexIndex v = 0; v < indexEnd(); ++v)
    {
      forEachTriangleFrom(v, use);
    }
  }
  /// The same for the triangles of which `v` is the corner of the lowest index: `a` is `v`.
  template <typename Use>
  void forEachTriangleFrom(VertexIndex v, const Use& use) const
  {
    const Ring& ring = rings_[v];
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      const VertexIndex b = ring[slot];
      const VertexIndex c = ring[ring.after(slot)];
      if (v < b && v < c)
      {
        use(v, b, c);
      }
    }
  }
  std::size_t triangleCount() const;
  /// Mean length of the edges.
  double meanEdge() const;
  double meanEdge(const Executor& executor) const;
  /// Whether there is any boundary.
  bool isOpen() const;
  bool isOpen(const Executor& executor) const;
  bool contains(const Triangle& triangle) const;

  /// Vertex split of `v` along the edges in the slots `first` and `first + steps` of its ring
  /// (counter-clockwise, steps >= 1): the new vertex takes over the edges from the one to the other
  /// and is joined to `v`. Of a boundary vertex, one of the two must be its boundary edge.
  bool canSplit(VertexIndex v, unsigned first, unsigned steps) const;
  VertexIndex split(VertexIndex v, unsigned first, unsigned steps, Vector4 position);

  /// Splits and collapses of vertices so far apart that no ring is changed by two of them may be made at
  /// the same time: splitInto() gives the index of a vertex that addVertices() has added, and what
  /// collapseOnly() has removed is told to eraseVertices() afterwards.
  std::vector<VertexIndex> addVertices(std::size_t count);
  void splitInto(
    VertexIndex v, unsigned first, unsigned steps, Vector4 position, VertexIndex added);
  void collapseOnly(VertexIndex removed, VertexIndex kept);
  void eraseVertices(std::span<const VertexIndex> removed);

  /// Half-edge collapse: `removed` vanishes into its neighbour `kept`, which does not move.
  /// Illegal: what breaks the link condition, a boundary vertex into an inner one or across an
  /// inner edge, boundary loops of three edges, the edges of a tetrahedron.
  bool canCollapse(VertexIndex removed, VertexIndex kept) const;
  void collapse(VertexIndex removed, VertexIndex kept);

  /// Edge flip: the inner edge a-b becomes the edge between the two vertices opposite to it.
  bool canFlip(VertexIndex a, VertexIndex b) const;
  void flip(VertexIndex a, VertexIndex b);

  /// Removes triangles, and more where two fans would be left at a vertex: then the smaller one
  /// goes, too (Figure 7.3). Vertices without triangles are erased. Triangles that are not there are
  /// passed over.
  struct Removal;
  Removal removeTriangles(std::span<const Triangle> triangles);

  /// Joins two boundary loops by a closed strip of triangles, which makes a handle, or one
  /// component of two. The strip begins at the edge between the first vertices of both. Each of
  /// `alongFirst` is a triangle: on the next edge of the first loop, or of the second one. The
  /// first loop is in the order of its direction (each vertex is followed by the last one in its
  /// ring), the second one against it.
  bool canJoin(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
    const std::vector<bool>& alongFirst) const;
  void join(std::span<const VertexIndex> first, std::span<const VertexIndex> second,
    const std::vector<bool>& alongFirst);

  /// Fills the corner of the boundary at `v`, which becomes an inner vertex, with a triangle.
  bool canFill(VertexIndex v) const;
  void fill(VertexIndex v);

  /// A value for each vertex, which follows all operations. All vertices begin with `first`.
  template <typename T>
  VertexProperty<T> addProperty(T first, OnSplit onSplit)
  {
    return properties_.add(indexEnd(), first, onSplit);
  }
  /// Forgets all of them.
  void dropProperties() { properties_ = VertexProperties(); }
  /// The values of a property, by the index of the vertex.
  template <typename T>
  std::span<T> values(VertexProperty<T> property)
  {
    return properties_.values(property);
  }
  template <typename T>
  std::span<const T> values(VertexProperty<T> property) const
  {
    return properties_.values(property);
  }

  /// Memory for `count` indices: up to there no operation allocates.
  void reserve(std::size_t count);
  void reserve(std::size_t count, const Executor& executor);
  /// Lets the indices of erased vertices be used again.
  void releaseErased();
  /// Closes the gaps in the indices that erased vertices leave; vertices keep their order. Returns
  /// the old index of each.
  std::vector<VertexIndex> dropErased();
  std::vector<VertexIndex> dropErased(const Executor& executor);
  /// Gives the vertex `permutation[i]` the index i, for all vertices; erased ones vanish.
  void renumber(std::span<const VertexIndex> permutation);
  void renumber(std::span<const VertexIndex> permutation, const Executor& executor);

  /// Gives the memory of the rings back to the system until restoreRings(), which gets the same rings. In between there
  /// is nothing but positions and properties.
  void releaseRings();
  void restoreRings(const CompactRings& rings, const Executor& executor);

  /// Turns all triangles of the given vertices, which must be whole components, inside out.
  void reverseOrientation(std::span<const VertexIndex> component);

  /// Writes the mesh as it is, with its properties, or reads it: about 38 bytes a vertex.
  void exchange(Archive& archive);

private:
  friend class StoredMesh;

  template <typename Take>
  void closeGaps(std::size_t count, const Take& take, const Executor& executor);
  VertexIndex newVertex(Vector4 position);
  void eraseVertex(VertexIndex v);
  bool isSound() const;

  LargeVector<Ring> rings_;
  LargeVector<Vector4> positions_;
  VertexProperties properties_;
  std::vector<VertexIndex> erased_;
  std::vector<VertexIndex> reusable_;
  std::size_t vertexCount_ = 0;
};

/// What removeTriangles() did.
struct Mesh::Removal
{
  std::vector<VertexIndex> vertices; ///< where something was removed; some, or all, may be gone
  std::size_t triangleCount = 0;
};
}
