// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/NearestPoints.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// What the points say of a mesh that is to explain them.
struct Evidence
{
  /// The share of the points that lie off the mesh although they are part of a surface: farther from it
  /// than half an edge, five median distances and three times the distance to their own neighbours, and
  /// yet in one layer with these. Outliers are in none.
  double unexplained = 1.;
  /// The median distance of the points, in edges of the mesh: more than a few hundredths where the mesh
  /// lies between layers, or noise is as wide.
  double medianInEdges = 1.;
};

constexpr std::size_t UsuallyAsked = 4000;

/// Asks so many points, evenly picked.
Evidence evidenceFor(const PointCloud& cloud, const NearestPoints& nearest, const Mesh& mesh,
  std::size_t pointsAsked = UsuallyAsked, const Executor& executor = Executor::sequential());
}
