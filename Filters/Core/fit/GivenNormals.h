// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace neuralmesh
{
/// The given normal of a point of a cloud, with any length.
using PointNormals = std::function<Vector4(std::size_t)>;

/// The given normals of the samples of a fit, and their weight. The weight follows from their
/// differences from the normals of the mesh while it is smooth. Signs do not count. Normals that
/// are zero, random, or turned together from those of the surface have no weight.
class GivenNormals
{
public:
  /// Takes the normals of the samples, with any length; none if there are no normals.
  GivenNormals() = default;
  explicit GivenNormals(std::vector<Vector4> normals);

  bool any() const { return !normals_.empty(); }
  /// The normal of a sample with length 1, or 0 if none is given.
  Vector4 at(std::size_t sample) const { return normals_[sample]; }

  /// The weight of a normal relative to a sample whose distance has this variance. It counts for
  /// the distance by which an edge of the triangle leaves the plane of the normal. 0 if the normals
  /// are unreliable.
  double weight(const Mesh& mesh, const PlacedSamples& samples, double variance) const;

private:
  std::vector<Vector4> normals_;
};
}
