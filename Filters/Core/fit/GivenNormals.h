// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace neuralmesh
{
/// The normal that came with a point of a cloud, of any length.
using PointNormals = std::function<Vector4(std::size_t)>;

/// Normals that came with the samples of a fit, and how much they tell of the surface: that is measured, by
/// how far they are from those of the mesh, while it is smooth. Their signs do not count. Normals that are zero,
/// random, or turned together from those of the surface tell nothing.
class GivenNormals
{
public:
  /// Of the samples, of any length; none: there are no normals.
  GivenNormals() = default;
  explicit GivenNormals(std::vector<Vector4> normals);

  bool any() const { return !normals_.empty(); }
  /// Of length 1, or 0 where nothing is given.
  Vector4 at(std::size_t sample) const { return normals_[sample]; }

  /// How much a normal weighs, against a sample whose distance has this variance, for the distance by which an
  /// edge of its triangle leaves the plane that it tells. 0 if normals are not to be trusted.
  double weight(const Mesh& mesh, const PlacedSamples& samples, double variance) const;

private:
  std::vector<Vector4> normals_;
};
}
