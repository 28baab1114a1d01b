// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <functional>
#include <memory>

namespace neuralmesh
{
/// Told how much of a run is done, 0 to 1; ends the run by returning false.
using Progress = std::function<bool(double fraction)>;

/// Reports a part of a run as that part of the whole. `whole` must outlive it.
inline Progress partOf(const Progress& whole, double begin, double end)
{
  return [&whole, begin, end](double fraction) { return whole(begin + fraction * (end - begin)); };
}

/// Tells no less than before: a part that ended early, or that begins anew, takes nothing back. `whole` must outlive it.
inline Progress rising(const Progress& whole)
{
  return [&whole, last = std::make_shared<double>(0.)](double fraction)
  { return whole(*last = std::max(*last, fraction)); };
}
}
