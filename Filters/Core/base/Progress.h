// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace neuralmesh
{
/// Told how much of a run is done, 0 to 1; ends the run by returning false.
using Progress = std::function<bool(double fraction)>;

/// Reports a part of a run as that part of the whole. `whole` must outlive it.
inline Progress partOf(const Progress& whole, double begin, double end)
{
  return [&whole, begin, end](double fraction) { return whole(begin + fraction * (end - begin)); };
}
}
