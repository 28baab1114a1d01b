// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/Reconstruction.h"

#include <algorithm>
#include <string>

namespace neuralmesh::testing
{
inline bool hasWarning(const Reconstruction& result, const std::string& text)
{
  return std::any_of(result.warnings.begin(), result.warnings.end(),
    [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}
}
