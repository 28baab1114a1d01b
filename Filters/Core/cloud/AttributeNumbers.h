// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/CloudPlaces.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Writes the numbers of a point, by its index in the input, into `tuple`.
using NumbersOf = std::function<void(std::uint32_t point, std::span<double> tuple)>;

/// Carries numbers of points, so many components each, over to the vertices of the mesh, by an AttributeFit.
/// A component never leaves the range that it has at the points. Points with a number that is not finite do not
/// count; vertices next to which all points are such have NaN. The numbers of one vertex come after those of the
/// other. The cloud of the places must know the origins of its points.
std::vector<double> carryNumbers(const CloudPlaces& places, std::size_t components,
  const NumbersOf& numbersOf, const Executor& executor = Executor::sequential());
}
