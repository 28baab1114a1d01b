// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Arrays.h"

#include "cloud/OrientationHints.h"

#include <optional>

namespace neuralmesh::binding
{
/// What a user knows of the outer side, in arrays that outlive the run.
struct Sides
{
  ArrayOf<double> viewpoints;                  ///< of shape (V, 3)
  std::optional<ArrayOf<std::uint32_t>> views; ///< of shape (N,)
  std::optional<ArrayOf<double>> normals;      ///< of shape (N, 3)
  std::optional<ArrayOf<double>> up;           ///< of shape (3,)

  OrientationHints hints() const;
  /// Throws std::invalid_argument where views or normals are not as many as the points.
  void requireCount(std::size_t points) const;
};
}
