// SPDX-License-Identifier: BSD-3-Clause
#include "run/RunEstimate.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// The program without data, and what is held at the peak beyond the input itself.
constexpr double BytesOfProgram = 52e6;
constexpr double BytesPerPoint = 42.;
constexpr double BytesPerVertex = 400.;

/// Up to about so many vertices the mesh is in the cache. Each doubling beyond adds this part of
/// the time of a sample, averaged over the run; see the table of growth in the README.
constexpr double CachedVertices = 32768.;
constexpr double SlowdownPerDoubling = 0.35;

/// The rest of the vertices are those of the average mesh.
constexpr double PartLearntByEnsemble = 0.75;
}

RunEstimate estimateRun(
  const PlannedRun& run, std::span<const GrowthRow> growth, double secondsOfTrial)
{
  RunEstimate estimate;
  estimate.bytes =
    BytesOfProgram + run.bytesOfPoints + BytesPerPoint * run.points + BytesPerVertex * run.vertices;
  if (growth.size() < 2)
  {
    return estimate;
  }
  // As the second half of the small mesh went, so will the rest.
  const GrowthRow& last = growth.back();
  std::size_t place = growth.size() - 1;
  while (place > 0 && growth[place].vertices > 0.5 * last.vertices)
  {
    --place;
  }
  const GrowthRow& middle = growth[place];
  const double iterations = last.iterations - middle.iterations;
  const double vertices = last.vertices - middle.vertices;
  const double left =
    (run.isEnsemble ? PartLearntByEnsemble : 1.) * std::max(0., run.vertices - last.vertices);
  const double samplesLeft = left * iterations / std::max(1., vertices) + run.samplesForFeatures;
  const double slowdown =
    1. + SlowdownPerDoubling * std::max(0., std::log2(run.vertices / CachedVertices));
  const double secondsLeft = samplesLeft * slowdown * (last.seconds - middle.seconds) / iterations;
  estimate.samples = last.iterations + samplesLeft;
  estimate.seconds = (run.isEnsemble ? secondsOfTrial : last.seconds) + secondsLeft;
  return estimate;
}
}
