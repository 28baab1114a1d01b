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
  double value = 0.;          ///< of a choice, the number of its word
  double error = 0.; ///< of held-out points, root of the mean square, in units of the input
  double gain = 0.;  ///< by which the mean square is less than that of the best, as a part of it
  double doubt = 0.; ///< standard error of the gain
  bool isTaken = false;
};

/// A parameter that was changed.
struct TuningChoice
{
  std::string_view parameter;
  double before = 0.;
  double value = 0.;

  /// NAME=VALUE.
  std::string assignment() const;
};

/// What was chosen for a cloud.
struct Tuning
{
  Parameters parameters;
  std::vector<TuningChoice> choices;
  std::vector<TuningTrial> trials;
  std::vector<std::string> remarks; ///< what decided besides the trials, in words

  /// Why, in words: trials and remarks, a line each.
  std::vector<std::string> reasons() const;
};

/// Those that are chosen, by the names of their properties.
inline constexpr std::array<std::string_view, 2> TunedParameters{ "Fidelity", "FitSmoothness" };

/// The word for a value of one of them; empty where values are numbers.
std::string_view tunedWord(std::string_view parameter, double value);

/// Chooses the TunedParameters for a cloud; all others stay as they are.
///
/// Short runs are made on patches of the cloud (see TuningPatch), with the one value or the other.
/// A value is taken if held-out points lie closer to the mesh then, by at least 1 % of their mean
/// square and three standard errors. A higher Fidelity is not tried where it does the same, as
/// high does under noise.
///
/// Returns nothing if it was ended before.
std::optional<Tuning> tune(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const Executor& executor = Executor::sequential());
}
