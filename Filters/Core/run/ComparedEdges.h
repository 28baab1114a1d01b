// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Random.h"
#include "mesh/NearestTriangle.h"
#include "mesh/SharpEdges.h"

#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// The sharp edges of a surface, at which it turns by more than 30 degrees, and random points on
/// them.
class ComparedEdges
{
public:
  /// The extent of the surface is about 1. One point lies in each of `count` equal parts of the
  /// length, if there are edges.
  ComparedEdges(const TriangleMesh& surface, std::size_t count, Random random);

  /// The length of all sharp edges; 0 if there are none.
  double length() const { return lengthUpTo_.empty() ? 0. : lengthUpTo_.back(); }
  /// The mean distance of the points to the nearest place on the edges of another surface; NaN if
  /// one of the two has no edges.
  double meanTo(const ComparedEdges& other, const Executor& executor) const;
  /// The mean distance of the points to another surface; NaN if there are no points.
  double meanTo(const NearestTriangle& surface, const Executor& executor) const;

private:
  Eigen::Vector3d pointAt(double length) const;

  std::vector<EdgeEnds> edges_;
  std::vector<double> lengthUpTo_;
  std::vector<Eigen::Vector3d> points_;
  NearestTriangle nearest_;
};
}
