// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "cloud/NearestPoints.h"
#include "cloud/PointCloud.h"
#include "start/FrontSurface.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>

namespace neuralmesh
{
/// Whether the samples of a front agree on their surface, and nearly all lie on it.
bool isCertain(const FrontSurface& front);

/// Makes a front of samples that a seed picks, in that part of the time.
using FrontMaker = std::function<std::optional<FrontSurface>(
  Layers layers, std::uint64_t seed, double begin, double end)>;

/// The front that agrees best with itself, if any does: of samples that take layers for one, of samples that
/// keep them apart, and of other samples where these two differ in handles that chance may have made. Those of another
/// one may be chance, too: so one more is asked.
std::optional<FrontSurface> bestFront(const FrontMaker& frontOf);

/// The same of a cloud. `mustBeCertain` if there is a closed solid already: then only one that is certain counts.
std::optional<FrontSurface> bestFront(const PointCloud& cloud, const NearestPoints& nearest,
  std::size_t mostVertices, const Progress& progress, double leastPiece, bool mustBeCertain);
}
