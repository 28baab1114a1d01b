// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"

#include <optional>

namespace neuralmesh
{
/// The cloud without clusters of outliers; nothing if it has none. A cluster fills a part of space,
/// where a surface, even with noise, is thin. Where one hides the surface, what this is there
/// follows from the solid around it, and the points close to that stay. Of an open scan only those
/// clusters go that do not touch it. Nothing, too, if `progress` ended it: it is told of no part, but asked often.
std::optional<PointCloud> withoutClusters(
  const PointCloud& cloud, const Progress& progress = [](double) { return true; },
  const Executor& executor = Executor::sequential());
}
