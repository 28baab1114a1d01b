// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "cloud/NearestPoints.h"
#include "cloud/PointCloud.h"
#include "start/FrontSurface.h"

#include <cstddef>
#include <optional>

namespace neuralmesh
{
/// Whether the samples of a front agree on their surface, and nearly all lie on it.
bool isCertain(const FrontSurface& front);

/// The front that agrees best with itself, if any does: of samples that take layers for one, of samples that
/// keep them apart, and of other samples where these two differ in handles that chance may have made.
/// `mustBeCertain` if there is a closed solid already: then only one that is certain counts.
std::optional<FrontSurface> bestFront(const PointCloud& cloud, const NearestPoints& nearest,
  std::size_t mostVertices, const Progress& progress, double leastPiece, bool mustBeCertain);
}
