// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/CloudPlaces.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace neuralmesh
{
/// Writes the values of a point, by its index in the input.
using ValuesOfPoint = std::function<void(std::size_t origin, double* values)>;

/// Carries so many values at each point over to the vertices: for each vertex so many, one vertex behind
/// the other. They stay between the least and the largest of the points; points that have one that is not
/// finite do not count; NaN where no point tells. The cloud must know the origins of its points.
std::vector<double> carryValues(const CloudPlaces& places, std::size_t components,
  const ValuesOfPoint& valuesOf, const Executor& executor = Executor::sequential());
}
