// SPDX-License-Identifier: BSD-3-Clause
// The choice of a number of vertices: its goal, its trials and its result.
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
/// The goal of a run without a given number of vertices.
struct SizeGoal
{
  double tolerance = 0.;  ///< 0: as many vertices as the points support
  bool isPercent = false; ///< of the diagonal of the bounding box, instead of units of the input
  ToleranceMeasure measure = ToleranceMeasure::RootMeanSquare;

  bool isAutomatic() const { return tolerance == 0.; }
  /// The tolerance in units of the input.
  double lengthFor(const PointCloud& cloud) const;
};

/// The goal of a run, if it has no number of vertices; nothing if it has.
std::optional<SizeGoal> sizeGoalOf(
  std::uint64_t vertices, double tolerance, bool isPercent, ToleranceMeasure measure);

/// Other requests that the choice of a number excludes.
struct BesideSize
{
  bool firstMesh = false;
  bool checkpoint = false;
  bool snapshots = false;
  bool automatic = false;
  bool levels = false;
};

/// The reason why such a run is impossible, as a sentence; empty if it is possible.
std::string whyNoSize(const Parameters& parameters, const BesideSize& beside = {});

/// The reason why no number can be chosen for this cloud, as a sentence; empty if one can.
std::string whyNoSizeFor(const PointCloud& cloud, const SizeGoal& goal);

/// A trial mesh. Its error is in units of the input, without noise.
struct SizeTrial
{
  std::uint64_t vertices = 0;
  double error = 0.;
};

/// The error of a mesh under noise by its number of vertices: it falls down to a floor that the
/// noise causes.
struct ErrorUnderNoise
{
  double errorWith(std::uint64_t vertices) const;

  double coarseness = 0.; ///< error that a mesh of one vertex would have
  double exponent = 0.;   ///< power of the number of vertices by which it falls
  double floor = 0.;
};

/// The chosen number of vertices, with its reasons.
struct SizeChoice
{
  /// The expected error with so many vertices, by the last trials; nothing if these do not
  /// determine it.
  std::optional<double> expectedWith(std::uint64_t vertices) const;

  /// The reasons in words, a line each.
  std::vector<std::string> reasons() const;
  /// The warning that the tolerance was not met; else empty.
  std::string warning() const;

  SizeGoal goal;
  double length = 0.;                     ///< the tolerance in units of the input
  double noise = 0.;                      ///< of a point, without which errors are; 0 if unknown
  std::optional<ErrorUnderNoise> byNoise; ///< if the number was chosen by the noise
  bool byCreases = false;                 ///< whether creases limit the number
  std::vector<SizeTrial> trials;          ///< by ascending numbers, without the result
  std::uint64_t vertices = 0;             ///< of the result
  double predicted = 0.;                  ///< error that was expected for the result
  double reached = 0.;
  double least = 0.; ///< smaller errors are not significant under the noise
};
}
