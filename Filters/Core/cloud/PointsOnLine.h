// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PointCloud.h"

namespace neuralmesh
{
/// Whether all points of a cloud lie on a straight line, as they do where a column of a table was read for another
/// one: no farther from it than a ten-thousandth of its length.
bool areOnLine(const PointCloud& cloud);
}
