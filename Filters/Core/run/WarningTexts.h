// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <string_view>

namespace neuralmesh
{
// The words that warnings have in common.

/// So many places are named in one sentence; the others are counted.
inline constexpr std::size_t MostPlacesNamed = 2;

/// With less points a vertex, the mesh follows single points.
inline constexpr std::size_t LeastPointsPerVertex = 2;

/// "1 piece", "2 pieces".
std::string counted(std::size_t count, std::string_view one, std::string_view several);
std::string percent(double share);
std::string about(double points);
/// A place as a user would type it, in digits that tell it apart from others of the cloud.
std::string placeText(const Eigen::Vector3d& place, const PointCloud& cloud);
/// What follows the places that a sentence names.
std::string otherPlaces(std::size_t count, std::size_t named);
}
