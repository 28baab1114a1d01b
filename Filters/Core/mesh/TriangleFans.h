// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Ring.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace neuralmesh
{
/// The triangles around each point of an oriented 2-manifold, with or without boundary, found from
/// the triangles alone.
class TriangleFans
{
public:
  /// A corner is 3 t + k for the k-th of triangle t.
  using Corner = std::uint32_t;

  struct Fan
  {
    std::vector<Corner> corners;        ///< of the triangles, counter-clockwise
    std::vector<VertexIndex> neighbors; ///< as in a Ring: one more than corners if the fan is open
    bool isOpen = false;
  };

  /// Throws std::runtime_error if the triangles are no such manifold, with a text that tells why
  /// and names the points. All indices must be below the number of points, and there must be less
  /// than 2^32 corners.
  explicit TriangleFans(const TriangleMesh& mesh);

  /// The number of neighbours; 0 if no triangle uses the point.
  unsigned valence(VertexIndex point) const { return valences_[point]; }
  /// Of a point in use. A fan that is not open begins at its lowest corner.
  Fan at(VertexIndex point) const;

private:
  static constexpr Corner NoCorner = 0xffffffffu;

  /// The corner of the next triangle of the fan.
  Corner after(Corner corner) const;
  VertexIndex pointAt(Corner corner) const { return mesh_.triangles[corner / 3][corner % 3]; }

  void requireDistinctCorners() const;
  void linkSides();
  void findFans();

  const TriangleMesh& mesh_;
  /// The side from a corner to the next one of its triangle bears the name of the corner. Here is
  /// the one that runs along the same edge the other way.
  std::vector<Corner> opposite_;
  std::vector<Corner> first_; ///< of each point
  std::vector<unsigned> valences_;
};
}
