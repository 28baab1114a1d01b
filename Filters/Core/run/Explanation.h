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
#include <optional>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// The reason for the distance of a point of the input to the mesh.
enum class Reason : std::uint8_t
{
  Explained, ///< the mesh is there
  Outlier,   ///< away from the mesh, and apart from other points or in a cluster that was left out;
             ///< or very far from all others (PointCloud::farPoints())
  SmallPiece,  ///< away from the mesh, with few other points, and not beside explained ones
  Unreachable, ///< away from the mesh, with many other points: the surface is missing there
  Dropped      ///< no coordinates, no weight, too far off, or of a pile
};
constexpr std::size_t Reasons = 5;

/// "explained", "outlier", "small piece", "unreachable", "dropped".
std::string_view name(Reason reason);

/// A connected piece of points that the mesh does not reach.
struct MissedPiece
{
  Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the coordinates of the input
  double points = 0.;                               ///< about the number of points of the cloud
  double farthest = 0.;                             ///< from the mesh, in units of the input
  bool isBeyondBoundary = false; ///< whether most points are nearest to a boundary of the mesh

  /// Whether the mesh is there but too coarse: no point is farther away than half an edge.
  bool isCoarse(double meanEdge) const { return !isBeyondBoundary && farthest < 0.5 * meanEdge; }
};

/// Explained points that the mesh does not quite reach.
struct CutOffPoints
{
  std::size_t count = 0; ///< number among the points asked
  Eigen::Vector3d place =
    Eigen::Vector3d::Zero(); ///< the farthest one, in the coordinates of the input
  double farthest = 0.;      ///< its distance to the mesh, in units of the input
  /// One that has others within two edges, more than chance puts there, in the coordinates of the input
  std::optional<Eigen::Vector3d> together;
};

/// The points of a cloud that a mesh explains, and those that it does not. The spacing of a point
/// is its mean distance to its six nearest neighbours. A point is away from the mesh if it is
/// farther than three of its spacings, and farther than the noise: eight median distances. It is an
/// outlier if its spacing is three times that of its neighbours. It is also one if its spacing is
/// three times the usual one, and the points of its piece form no layer.
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
  /// Points that were left out together before a run, as they have no surface: how many, and one of them.
  std::size_t leftOutPoints = 0;
  Eigen::Vector3d leftOutPlace = Eigen::Vector3d::Zero();
  /// Points that belong together and are explained, though the mesh passes them by: where it has nearly as many vertices
  /// as the cloud has points, or as most points of a piece of the mesh, or farther than noise puts points that lie
  /// together. The largest first.
  std::vector<MissedPiece> passedBy;
  /// As rims are that are narrower than edges are long: farther from the mesh than from each other, and than any noise,
  /// and not beyond a boundary.
  CutOffPoints atRims;
  /// Sparse points beyond a boundary that are farther from it than 1.6 times their spacing.
  CutOffPoints beyondEnds;
  double scatteredShare = 0.; ///< of a run: see ScatteredPoints.h

  double count(Reason reason) const { return counts[std::size_t(reason)]; }
  /// The number of points that the mesh does not reach and that are no outliers.
  double unexplained() const { return count(Reason::SmallPiece) + count(Reason::Unreachable); }
  /// Their part of all points that were not dropped.
  double unexplainedShare() const;
};

struct ExplanationRules
{
  /// A piece with less than this part of all points is small, unless it continues explained points.
  double leastPiece = 0.0005;
  /// For each point, 1 if it is in a cluster of outliers; empty if there are none.
  std::vector<std::uint8_t> isLeftOut;
  /// As many points are asked where not all are to be explained; 0: as many as are.
  std::size_t usuallyAsked = 0;
};

/// Takes about as long as the distances.
Explanation explain(const PointCloud& cloud, PointDistances distances,
  const ExplanationRules& rules, const Executor& executor = Executor::sequential());
}
