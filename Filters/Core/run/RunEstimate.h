// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace neuralmesh
{
/// A rough estimate of the memory and time of a run.
struct RunEstimate
{
  double bytes = 0.;   ///< of memory, at the peak, the whole process
  double samples = 0.; ///< that will be drawn
  double seconds = 0.; ///< of processor time, on all threads

  /// As lines of a report: memory alone if no more is known. A second of processor time takes `wallSeconds`.
  std::string report(double wallSeconds) const;
};

/// The figures of a run that are known beforehand.
struct PlannedRun
{
  double vertices = 0.; ///< of the mesh
  double points = 0.;
  double bytesOfPoints = 0.; ///< that the input takes
  double samplesForFeatures = 0.;
  double samplesPerAddition = 0.;
  double mostSamples = 0.; ///< of learning, at which it ends; 0: any number
  bool isEnsemble = false;
};

/// The state of a run: a row of its learning curve.
struct GrowthRow
{
  double iterations = 0.;
  double vertices = 0.;
  double seconds = 0.;
};

/// A run that was made to see what a larger one takes.
struct TrialRun
{
  double vertices = 0.; ///< that it was to have
  std::vector<GrowthRow> growth;
  // Seconds of processor time.
  double cloudTime = 0.; ///< with the choice of parameters
  double startTime = 0.;
  double learningTime = 0.;
  double finishTime = 0.;
};

/// Number of vertices by which a mesh grows to measure its speed.
inline constexpr std::uint64_t TriedVertices = 5000;
/// The first surface of a larger mesh is tried with so many: it takes time itself.
inline constexpr std::uint64_t MostTriedStart = 200000;
/// Vertices that are added to a first surface that is tried.
inline constexpr std::uint64_t TriedAdditions = 1000;

/// Vertices that such a run learns, for a finer mesh would follow single points.
double learntVertices(const PlannedRun& run);

/// The memory alone.
double estimatedBytes(const PlannedRun& run);

/// By a run of TriedVertices vertices, or as many more than its first mesh, how it goes on to all vertices, and what the
/// finish takes. Where learning starts from the points, `start` is the beginning of the run itself, or of one with
/// MostTriedStart vertices: the first surface has more vertices the more there are to be, as far as the points tell
/// more. Else `start` has no growth. Time limits and targets of distance are not foreseen, nor that a mesh that has lost
/// thin parts is made again: such runs take less, or more. Of a trial without growth only the memory is told.
RunEstimate estimateRun(const PlannedRun& run, const TrialRun& trial, const TrialRun& start = {});
}
