// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "run/PointDistances.h"
#include "run/TornParts.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// Why a point of the input lies where it lies against the mesh.
enum class Reason : std::uint8_t
{
  Explained, ///< the mesh is there
  Outlier, ///< away from the mesh, and apart from other points, or in a cluster that was left out; or very
           ///< far from all others (PointCloud::farPoints())
  SmallPiece,  ///< away from the mesh, with few others, and not beside what is explained
  Unreachable, ///< away from the mesh, though there are others: the surface is missing there
  Dropped      ///< no coordinates, no weight, or too far off to be taken in
};
constexpr std::size_t Reasons = 5;

/// "explained", "outlier", "small piece", "unreachable", "dropped".
std::string_view name(Reason reason);

/// Points that belong together and that the mesh does not reach.
struct MissedPiece
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the coordinates of the input
  double points = 0.;                               ///< of the cloud, about
  double farthest = 0.;                             ///< from the mesh, in units of the input
  bool isBeyondBoundary = false; ///< whether most of them lie nearest to a boundary of the mesh

  /// Whether the mesh is there, but too coarse: they are no farther than half an edge.
  bool isCoarse(double meanEdge) const { return !isBeyondBoundary && farthest < 0.5 * meanEdge; }
};

/// Points that are explained, though the mesh does not quite reach them.
struct CutOffPoints
{
  std::size_t count = 0; ///< of those asked
  Eigen::Vector3d place =
    Eigen::Vector3d::Zero(); ///< of the farthest, in the coordinates of the input
  double farthest = 0.;      ///< from the mesh, in units of the input
};

/// What a mesh leaves of a cloud. A point is away from the mesh if it is farther than three of its own
/// distances to its six nearest neighbours, and than any noise: than eight median distances. It is an
/// outlier if its own distances are three times those of its neighbours; or three times those that are
/// usual, and most of those that are away with it lie in no layer.
struct Explanation
{
  PointDistances asked;
  std::vector<Reason> reasons; ///< of the points asked
  std::array<double, Reasons>
    counts{};                      ///< of the points of the input, about; exact if all are asked
  std::vector<MissedPiece> pieces; ///< that are unreachable, the largest first
  /// Of small pieces, those that a closer look shows as parts of the scan: their points lie as dense as others and
  /// form a surface. The largest first.
  std::vector<MissedPiece> smallParts;
  TornParts torn; ///< of what is explained
  /// Points that belong together and are explained, though the mesh passes them by: where it has nearly as many vertices
  /// as the cloud has points, or as most points of a piece of the mesh. The largest first.
  std::vector<MissedPiece> passedBy;
  /// As rims are that are narrower than edges are long: farther from the mesh than from each other, and than any noise,
  /// and not beyond a boundary.
  CutOffPoints atRims;
  /// Where points are sparse, beyond a boundary, and farther from it than one and a half distances between them.
  CutOffPoints beyondEnds;
  double scatteredShare = 0.; ///< of a run: see ScatteredPoints.h

  double count(Reason reason) const { return counts[std::size_t(reason)]; }
  /// Points that are no outliers, and that the mesh does not reach.
  double unexplained() const { return count(Reason::SmallPiece) + count(Reason::Unreachable); }
  /// Of all that were not dropped.
  double unexplainedShare() const;
};

/// What decides.
struct ExplanationRules
{
  /// Fewer points than this part of all are a small piece, unless they go on from what is explained.
  double leastPiece = 0.0005;
  /// Points that the run took for clusters of outliers; empty if it has none.
  std::vector<std::uint8_t> isLeftOut;
};

/// Takes about as long as the distances do.
Explanation explain(const PointCloud& cloud, PointDistances distances,
  const ExplanationRules& rules, const Executor& executor = Executor::sequential());
}
