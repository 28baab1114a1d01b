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
/// Whether the residual of a mesh may grow.
enum class ResidualRule
{
  MayNotGrow, ///< any growth makes the mesh worse: the cloud is clean
  MayBeNoise, ///< it may grow up to the noise
  MayGrow     ///< no growth makes the mesh worse
};

/// Finds whether a mesh has become worse, by points that are held out of the fit:
/// - by their residual: the root mean square distance of those that are no outliers. A mesh that
///   follows the noise is closer to all points than the surface is. So a residual that is as large
///   as the noise is not worse;
/// - by their coverage: the number of points that the mesh misses, as they are farther away than
///   three times their distance to their neighbours, and than the noise. It is worse if the number
///   grows by more than two deviations of chance. The repair of intersections may lose one point in
///   500.
class FitGuard
{
public:
  /// Measures the mesh as it is now. Cloud and executor must outlive the guard. `to` says how
  /// distances are measured; with DistanceTo::NearestTriangle, for points of a surface, no point is
  /// an outlier.
  FitGuard(const PointCloud& cloud, const Mesh& mesh,
    const Executor& executor = Executor::sequential(), DistanceTo to = DistanceTo::Surface);

  /// Whether `mesh` is worse than the first one.
  bool isWorse(const Mesh& mesh, ResidualRule rule, bool isRepaired = false);
  /// Whether the residual of `mesh` exceeds that of `before` by more than this part.
  bool hasGrown(const Mesh& before, const Mesh& mesh, double part) const;
  /// Whether `mesh` misses more points than the first one.
  bool losesPoints(const Mesh& mesh, bool isRepaired);
  /// Whether `mesh` misses more points than `before` by their distances to their neighbours alone, be these below the
  /// noise.
  bool losesDensePoints(const Mesh& before, const Mesh& mesh);

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
  std::optional<PointSpacing> spacing_; ///< made when it is needed
};
}
