// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "start/VoxelGrid.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// If more than this part of all points are in clusters, these are what was scanned.
inline constexpr double MostPartOfClusters = 0.3;

/// Whether points fill a ball, instead of lying on a surface: around them the cloud is as thick as it is wide at every
/// scale, from that of the nearest neighbours to that of all points; and as a whole they are no shell, with few points in
/// the middle. Of few points this is not told: then they do not.
bool areScattered(std::span<const Vector4> points);

/// Small groups of points that are apart from all others and lie on no surface. A body under noise looks the same if it
/// is not thicker than the noise is wide: it is none of these. Where more than a thousand groups are apart, or the
/// clusters have too large a part of the points, there are none: they are what was scanned.
class SeparateClusters
{
public:
  /// `noise` gives the standard deviation of points across the surface; it is asked for where there may be a cluster.
  /// There are none if `progress` ended it.
  SeparateClusters(
    const PointCloud& cloud, const std::function<double()>& noise,
    const Progress& progress = [](double) { return true; },
    const Executor& executor = Executor::sequential());

  bool areNone() const { return isLeftOut_.empty(); }
  /// Whether a point belongs to one of them, or to what is strewn around it.
  bool hold(Vector4 point) const;

private:
  VoxelGrid grid_;
  std::vector<std::uint8_t> isLeftOut_; ///< voxels; empty if none is
};
}
