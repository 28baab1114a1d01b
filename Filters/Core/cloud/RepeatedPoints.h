// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"

#include <optional>

namespace neuralmesh
{
/// The cloud with each of its points once, if a third of them or more are repetitions of others, 500 are left, and
/// they have no weights; else nothing. What is told by how many points are where, as gaps are, would be wrong.
std::optional<PointCloud> withoutRepetitions(const PointCloud& cloud);
}
