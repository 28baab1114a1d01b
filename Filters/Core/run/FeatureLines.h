// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// A line from corner to corner, or around: then its last point is its first.
struct FeatureLine
{
  std::vector<std::uint32_t> points; ///< along it, by their index
  double angle = 0.;                 ///< between the sides, in degrees: the mean along the line
  double length = 0.;                ///< in units of the input
  std::size_t chain = 0; ///< lines that hang together have the same; the longest chain is 0
};

/// Where the surface has an edge that the points of the cloud confirm.
struct FeatureLines
{
  struct Corner
  {
    std::uint32_t point = 0;
    double angle = 0.; ///< the sharpest one there, in degrees
    std::size_t chain = 0;
  };

  std::vector<Eigen::Vector3d> points; ///< in the coordinates of the input
  std::vector<VertexIndex> vertices;   ///< of the mesh, for each point
  /// Where three or more lines meet, where one ends, and where one turns sharply.
  std::vector<Corner> corners;
  std::vector<FeatureLine> lines;
  /// Of each vertex of the mesh the sharpest angle of a line there, in degrees; 0 away from them.
  std::vector<double> creases;
};

/// Finds the lines along which the surface is sharper than `leastAngle`, in degrees, as findCreaseEdges() has
/// it. Edges that are less sharp, or not confirmed, belong to a line if they close a gap of at most ten edges in
/// it. What ends in the open after a few edges is no line, nor is a boundary. Lines run along edges of the
/// mesh, of which no vertex may be erased, but their points lie where the planes of both sides meet, at most
/// an edge away from their vertex. Nothing if `progress` ends it.
std::optional<FeatureLines> findFeatureLines(const Mesh& mesh, const PointCloud& cloud,
  double leastAngle, const Progress& progress, const Executor& executor = Executor::sequential());
}
