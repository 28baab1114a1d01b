// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Arrays.h"
#include "Call.h"

#include "learn/Parameters.h"

#include <vector>

namespace neuralmesh::binding
{
/// What is chosen for a cloud: dicts of `choices` and `trials`, and texts of `reasons`; None if it was ended.
/// Throws std::invalid_argument where nothing can be learnt of the points.
nanobind::object tuneFor(
  const std::vector<AnyArray>& points, const Parameters& wanted, unsigned threads, Call& call);
}
