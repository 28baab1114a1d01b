// SPDX-License-Identifier: BSD-3-Clause
// Parameters as Python has them: a dict of numbers, by the names of the properties.
#pragma once

#include "learn/Parameters.h"
#include "run/EnsembleParameters.h"

#include <nanobind/nanobind.h>

namespace neuralmesh::binding
{
/// The product's defaults, but for what the dict has. Choices and switches are numbers, too. Names that
/// the engine does not know are left out.
Parameters parametersOf(const nanobind::dict& values);
EnsembleParameters ensembleParametersOf(const nanobind::dict& values);

/// What a preset sets for a variant and an order.
nanobind::dict presetOf(Preset preset, Variant variant, Order order);
/// The parameters that tune() has chosen.
nanobind::dict tunedOf(const Parameters& parameters);
}
