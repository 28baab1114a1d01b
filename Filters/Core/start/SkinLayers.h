// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/NearestPoints.h"

namespace neuralmesh
{
/// Whether the points of a thick skin lie in two layers, and not in one that noise spreads. Noise has the most points in
/// the middle, two layers have few there: the skewness and kurtosis of the distances across tell. They are measured in
/// neighbourhoods of this radius, which should be twice the thickness.
bool lieInTwoLayers(const NearestPoints& nearest, float radius);
}
