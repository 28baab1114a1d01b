// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "learn/Parameters.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// A value that was tried for a parameter.
struct TuningTrial
{
  std::string_view parameter; ///< by the name of the property
  double before = 0.;         ///< its value in the best parameters so far
  double value = 0.;          ///< for a choice, the number of its word
  double error = 0.; ///< root mean square distance of held-out points, in units of the input
  double gain = 0.;  ///< reduction of the mean square of the best, as a part of it
  double doubt = 0.; ///< standard error of the gain
  bool isTaken = false;
};

/// A parameter that was changed.
struct TuningChoice
{
  std::string_view parameter;
  double before = 0.;
  double value = 0.;

  /// The change as NAME=VALUE.
  std::string assignment() const;
};

/// The parameters that were chosen for a cloud.
struct Tuning
{
  Parameters parameters;
  std::vector<TuningChoice> choices;
  std::vector<TuningTrial> trials;
  std::vector<std::string> remarks; ///< other reasons than the trials, in words

  /// The reasons in words: trials and remarks, a line each.
  std::vector<std::string> reasons() const;
};

/// The names of the properties that are chosen.
inline constexpr std::array<std::string_view, 2> TunedParameters{ "Fidelity", "FitSmoothness" };

/// The word for a value of one of them; empty if its values are numbers.
std::string_view tunedWord(std::string_view parameter, double value);

/// Chooses the TunedParameters for a cloud; all others stay as they are.
///
/// Short runs on patches of the cloud (see TuningPatch) try one value or the other. A value is
/// chosen if held-out points are closer to the mesh by at least 1 % of their mean square and by
/// three standard errors. A higher Fidelity is not tried if it makes the same rounds, as under
/// noise.
///
/// Returns nothing if `progress` ended it.
std::optional<Tuning> tune(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const Executor& executor = Executor::sequential());
}
