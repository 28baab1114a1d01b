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
/// The sharp edges of a surface, where it turns by more than 30 degrees, and points drawn evenly over their
/// length.
class ComparedEdges
{
public:
  /// On a surface whose extent is about 1. One point lies in each of `count` equal shares of the length, if
  /// there are edges.
  ComparedEdges(const TriangleMesh& surface, std::size_t count, Random random);

  /// 0 if no edge is sharp.
  double length() const { return lengthUpTo_.empty() ? 0. : lengthUpTo_.back(); }
  /// The mean distance of the points from the nearest place on the edges of another surface; NaN if one of
  /// the two has none.
  double meanTo(const ComparedEdges& other, const Executor& executor) const;
  /// ... or anywhere on another surface; NaN if there are no edges here.
  double meanTo(const NearestTriangle& surface, const Executor& executor) const;

private:
  Eigen::Vector3d pointAt(double length) const;

  std::vector<EdgeEnds> edges_;
  std::vector<double> lengthUpTo_;
  std::vector<Eigen::Vector3d> points_;
  NearestTriangle nearest_;
};
}
