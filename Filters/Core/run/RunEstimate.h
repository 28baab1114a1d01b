// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace neuralmesh
{
/// A rough estimate of the memory and time of a run.
struct RunEstimate
{
  double bytes = 0.;   ///< of memory, at the peak, the whole process
  double samples = 0.; ///< that will be drawn
  double seconds = 0.; ///< of learning on one core of this machine
};

/// The figures of a run that are known beforehand.
struct PlannedRun
{
  double vertices = 0.; ///< of the mesh
  double points = 0.;
  double bytesOfPoints = 0.; ///< that the input takes
  double samplesForFeatures = 0.;
  bool isEnsemble = false;
};

/// The state of a run: a row of its learning curve.
struct GrowthRow
{
  double iterations = 0.;
  double vertices = 0.;
  double seconds = 0.;
};

/// Number of vertices by which a mesh grows to measure its speed.
inline constexpr std::uint64_t TriedVertices = 5000;

/// Extrapolates to all vertices from the learning curve of a run with TriedVertices vertices, or
/// with so many more than its first mesh. `secondsOfTrial` is the time of that whole run. Time
/// limits and targets of distance are ignored: runs that end by them take less. With fewer than two
/// rows, only the memory is estimated.
RunEstimate estimateRun(
  const PlannedRun& run, std::span<const GrowthRow> growth, double secondsOfTrial);
}
