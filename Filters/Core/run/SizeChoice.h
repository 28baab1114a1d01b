// SPDX-License-Identifier: BSD-3-Clause
// How many vertices a mesh is to have where nobody says: what is wanted, what was tried, and what came of it.
#pragma once

#include "base/Choices.h"
#include "cloud/PointCloud.h"
#include "learn/Parameters.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neuralmesh
{
/// What a run without a number of vertices is to reach.
struct SizeGoal
{
  double tolerance = 0.;  ///< in units of the input; 0: all that the cloud tells
  bool isPercent = false; ///< ... or in percent of the diagonal of its bounding box
  ToleranceMeasure measure = ToleranceMeasure::RootMeanSquare;

  bool isAutomatic() const { return tolerance == 0.; }
  /// The tolerance in units of the input.
  double lengthFor(const PointCloud& cloud) const;
};

/// The goal of a run, if it has no number of vertices; nothing if it has.
std::optional<SizeGoal> sizeGoalOf(
  std::uint64_t vertices, double tolerance, bool isPercent, ToleranceMeasure measure);

/// What else a run may be asked for that the choice of a number excludes.
struct BesideSize
{
  bool firstMesh = false;
  bool checkpoint = false;
  bool snapshots = false;
  bool automatic = false;
  bool levels = false;
};

/// Why there is no such run, as a sentence; empty if there is.
std::string whyNoSize(const Parameters& parameters, const BesideSize& beside = {});

/// Why no number can be chosen for this cloud, as a sentence; empty if one can.
std::string whyNoSizeFor(const PointCloud& cloud, const SizeGoal& goal);

/// A mesh that was made to be measured: errors in units of the input, noise taken off.
struct SizeTrial
{
  std::uint64_t vertices = 0;
  double error = 0.;
};

/// What is left of the error of a mesh under noise: less for more vertices, down to what noise makes of it.
struct ErrorUnderNoise
{
  double errorWith(std::uint64_t vertices) const;

  double coarseness = 0.; ///< what one vertex would give
  double exponent = 0.;   ///< by which it falls with their number
  double floor = 0.;
};

/// A number of vertices, and why it is that.
struct SizeChoice
{
  /// Of the error that so many vertices would give, by the last trials; nothing if they do not tell.
  std::optional<double> expectedWith(std::uint64_t vertices) const;

  /// In words, a line each.
  std::vector<std::string> reasons() const;
  /// What is to be warned of: a tolerance that was not met; else empty.
  std::string warning() const;

  SizeGoal goal;
  double length = 0.;                     ///< the tolerance in units of the input
  double noise = 0.;                      ///< that was taken off, of one point; 0 if none is told
  std::optional<ErrorUnderNoise> byNoise; ///< if the number was chosen by it
  std::vector<SizeTrial> trials;          ///< of rising numbers; without the mesh itself
  std::uint64_t vertices = 0;             ///< that the mesh has
  double predicted = 0.;                  ///< before it was made
  double reached = 0.;
  double least = 0.; ///< no smaller error is told apart from none under the noise
};
}
