// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/CloudPlaces.h"

#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
constexpr std::uint32_t NoLabel = std::uint32_t(-1);

/// Carries labels of points over to the vertices of the mesh: each takes the label that weighs most
/// among the points on its triangles, by barycentric weight times that of the point; of equal ones
/// the lowest. A vertex without points takes the label of the nearest one that has some; NoLabel if
/// there is none in its component. `labels` are those of the points of the cloud.
std::vector<std::uint32_t> voteForLabels(
  const CloudPlaces& places, std::span<const std::uint32_t> labels);
}
