// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace neuralmesh
{
/// What a run will take, roughly.
struct RunEstimate
{
  double bytes = 0.;   ///< of memory, at the peak, the whole process
  double samples = 0.; ///< that will be drawn
  double seconds = 0.; ///< of learning on one core of this machine
};

/// What is known of a run beforehand.
struct PlannedRun
{
  double vertices = 0.; ///< of the mesh
  double points = 0.;
  double bytesOfPoints = 0.; ///< that the input takes
  double samplesForFeatures = 0.;
  bool isEnsemble = false;
};

/// What a run has come to: a row of its learning curve.
struct GrowthRow
{
  double iterations = 0.;
  double vertices = 0.;
  double seconds = 0.;
};

/// Vertices by which a mesh grows so as to see how fast it goes.
inline constexpr std::uint64_t TriedVertices = 5000;

/// From the learning curve of a run with TriedVertices vertices, or as many more than its first mesh, how it
/// goes on to all vertices. `secondsOfTrial` is what that took as a whole. Time limits and targets of
/// distance are not foreseen: runs that they end take less. Of a curve with fewer than two rows only the
/// memory is told.
RunEstimate estimateRun(
  const PlannedRun& run, std::span<const GrowthRow> growth, double secondsOfTrial);
}
