// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/CloudPlaces.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
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

/// A text that two points, by their indices in the input, have in common only if they are of one kind.
using KindOf = std::function<std::string(std::uint32_t point)>;

/// The same for points of any kinds: a vertex gets the lowest index in the input of a point of its kind, or
/// NoLabel. The cloud of the places must know the origins of its points.
std::vector<std::uint32_t> voteForKinds(const CloudPlaces& places, const KindOf& kindOf);
}
