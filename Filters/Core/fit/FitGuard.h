// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "fit/HeldOutPoints.h"
#include "fit/PointSpacing.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// What of the residual counts as worse.
enum class ResidualRule
{
  MayNotGrow, ///< any growth: the cloud is clean
  MayBeNoise, ///< growth beyond what noise all over would be
  MayGrow     ///< nothing
};

/// Tells whether a mesh has become worse than it was, by points that are held out of the fit:
/// - by their residual: the root of the mean squared distance of those that are no outliers. With
///   noise a mesh that follows it is closer to any point than the surface is, so that a residual
///   which is noise all over is none that has become worse;
/// - by their coverage: how many are missed, farther from the mesh than three of their own distances
///   to their neighbours, and than any noise: more of them than chance has it (two deviations).
///   If intersections were mended, that may cost one of 500.
class FitGuard
{
public:
  /// Of the mesh as it is. Cloud and executor must outlive the guard.
  /// Distances are measured to `to`; to the nearest triangle, of a surface, no point is an outlier.
  FitGuard(const PointCloud& cloud, const Mesh& mesh,
    const Executor& executor = Executor::sequential(), DistanceTo to = DistanceTo::Surface);

  /// Whether `mesh` is worse than the mesh was at first.
  bool isWorse(const Mesh& mesh, ResidualRule rule, bool isRepaired = false);
  /// Whether its residual is larger than that of `before` by more than this part.
  bool hasGrown(const Mesh& before, const Mesh& mesh, double part) const;
  /// Whether it misses more points than the mesh did at first.
  bool losesPoints(const Mesh& mesh, bool isRepaired);

private:
  bool hasGrown(const std::vector<float>& after, double meanEdge, ResidualRule rule) const;
  double residual(const std::vector<float>& squared, double meanEdge) const;
  bool losesPoints(const std::vector<float>& after, bool isRepaired);

  const PointCloud& cloud_;
  const Executor& executor_;
  DistanceTo to_;
  std::vector<std::size_t> points_;
  std::vector<float> before_; ///< squared distances
  double residual_ = 0.;
  std::optional<PointSpacing> spacing_; ///< known where it was needed
};
}
