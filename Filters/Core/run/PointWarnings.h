// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/WarningTopic.h"
#include "cloud/PointCloud.h"
#include "run/Explanation.h"

#include <cstddef>

namespace neuralmesh
{
/// Warns of points that are not in the cloud, as they lie where others do.
void warnOfNoDataValue(const PointCloud& cloud, WarningList& warnings);

void warnOfPiles(const PointCloud& cloud, WarningList& warnings);

/// Warns of the points that a mesh misses: how many, where, why, and what to do. The limits stand at warningsOf().
/// The mesh has so many vertices.
void warnOfPoints(const Explanation& explanation, const PointCloud& cloud, std::size_t vertices,
  WarningList& warnings);
}
