// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Vector4.h"
#include "cloud/NearestPoints.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// Fewer points are flat by chance.
inline constexpr std::size_t NeighborsInVariation = 9;

/// Of the variance of places, the part across the plane that fits them best; 1 if they are too few.
double variationOf(std::span<const NearPoint> near, std::span<const Vector4> places);
}
