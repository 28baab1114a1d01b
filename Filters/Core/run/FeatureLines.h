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
/// A line from corner to corner, or a loop, whose last point is its first.
struct FeatureLine
{
  std::vector<std::uint32_t> points; ///< along it, by their index
  double angle = 0.;                 ///< between the sides, in degrees: the mean along the line
  double length = 0.;                ///< in units of the input
  std::size_t chain = 0; ///< number of the connected chain of lines; the longest one has 0
};

/// The edges of the surface that the points of the cloud confirm, as lines.
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
  /// Points where three or more lines meet, where a line ends, and where a line turns sharply
  std::vector<Corner> corners;
  std::vector<FeatureLine> lines;
  /// For each vertex of the mesh the largest angle of a line there, in degrees; 0 without a line
  std::vector<double> creases;
};

/// Finds the lines along which the surface turns by more than `leastAngle`, in degrees, by
/// findCreaseEdges(). Other edges belong to a line if they close a gap of at most ten edges in it.
/// Short spurs and boundaries are no lines. Lines run along edges of the mesh, but their points lie
/// where the planes of both sides meet, at most an edge away from their vertex. No vertex may be
/// erased. Returns nothing if `progress` ends it.
std::optional<FeatureLines> findFeatureLines(const Mesh& mesh, const PointCloud& cloud,
  double leastAngle, const Progress& progress, const Executor& executor = Executor::sequential());
}
