// SPDX-License-Identifier: BSD-3-Clause
#ifndef NearestNames_h
#define NearestNames_h

#include <string>
#include <vector>

/**
 * Those of `names` that `mistyped` may be meant as, the nearest first, at most three: a third of the
 * letters may be wrong, missing, too many or swapped with the next one. Upper and lower case count
 * as the same.
 */
std::vector<std::string> NearestNames(
  const std::string& mistyped, const std::vector<std::string>& names);

/** "did you mean A or B?" of these; empty if there are none. */
std::string DidYouMean(const std::string& mistyped, const std::vector<std::string>& names);

#endif
