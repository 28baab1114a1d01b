// SPDX-License-Identifier: BSD-3-Clause
#include "run/RunEstimate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace neuralmesh
{
namespace
{
/// The program without data, and what is held at the peak beyond the input itself.
constexpr double BytesOfProgram = 52e6;
constexpr double BytesPerPoint = 42.;
constexpr double BytesPerVertex = 400.;

/// Up to about so many vertices the mesh is in the cache. Each doubling beyond adds this part of
/// the time of a sample, averaged over the run.
constexpr double CachedVertices = 32768.;
constexpr double SlowdownPerDoubling = 0.35;

/// The rest of the vertices are those of the average mesh.
constexpr double PartLearntByEnsemble = 0.75;

/// Fewer vertices a trial tells no pace by.
constexpr double FewestThatTellPace = 100.;

/// Without an exponent, and with the digits that an estimate deserves.
std::string inDigits(double value)
{
  const int decimals = value < 0.995 ? 2 : value < 9.95 ? 1 : 0;
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string duration(double seconds)
{
  constexpr double Minute = 60., Hour = 3600., MostMinutes = 100.;
  return seconds < MostMinutes       ? inDigits(seconds) + " s"
    : seconds < MostMinutes * Minute ? inDigits(seconds / Minute) + " min"
                                     : inDigits(seconds / Hour) + " h";
}

double slowdown(double vertices)
{
  return 1. + SlowdownPerDoubling * std::max(0., std::log2(vertices / CachedVertices));
}

/// From where on the rest of the trial went as the run will go on: a mesh that grows from nothing does so in its
/// second half.
const GrowthRow& representative(const std::vector<GrowthRow>& growth)
{
  std::size_t place = growth.size() - 1;
  while (place > 0 && growth[place].vertices > 0.5 * growth.back().vertices)
  {
    --place;
  }
  return growth[place];
}
}

std::string RunEstimate::report(double wallSeconds) const
{
  const std::string memory = "memory     about " + inDigits(1e-6 * bytes) + " MB\n";
  return samples > 0. || seconds > 0. ? "samples    about " + inDigits(1e-6 * samples) +
      " million\n" + memory + "time       about " + duration(seconds) + " of processor time, " +
      duration(seconds * wallSeconds) + " on this machine as it is now\n"
                                      : memory;
}

double learntVertices(const PlannedRun& run)
{
  constexpr double PointsPerVertex = 2., Least = 100.;
  return std::min(run.vertices, std::max(Least, run.points / PointsPerVertex));
}

double estimatedBytes(const PlannedRun& run)
{
  return BytesOfProgram + run.bytesOfPoints + BytesPerPoint * run.points +
    BytesPerVertex * run.vertices;
}

RunEstimate estimateRun(const PlannedRun& run, const TrialRun& trial, const TrialRun& start)
{
  RunEstimate estimate;
  estimate.bytes = estimatedBytes(run);
  if (trial.growth.empty())
  {
    return estimate;
  }
  const bool isStartTried = !start.growth.empty();
  const TrialRun& tried = isStartTried ? start : trial;
  const GrowthRow& last = tried.growth.back();
  const GrowthRow& middle = representative(tried.growth);
  const double iterations = last.iterations - middle.iterations;
  const double added = last.vertices - middle.vertices;
  const double samplesPerVertex =
    added >= FewestThatTellPace ? iterations / added : run.samplesPerAddition;
  // That of a first surface that is tried is in proportion to the mesh.
  const double scale = isStartTried ? learntVertices(run) / tried.vertices : 1.;
  const double before = scale * middle.vertices;
  const double samplesOfGrowth =
    samplesPerVertex * std::max(0., learntVertices(run) - before - scale * added);
  const double samplesWanted =
    (run.isEnsemble ? PartLearntByEnsemble : 1.) * samplesOfGrowth + run.samplesForFeatures;
  const double samplesLeft = run.mostSamples > 0.
    ? std::clamp(run.mostSamples - last.iterations, 0., samplesWanted)
    : samplesWanted;
  estimate.samples = run.mostSamples > 0. ? std::min(run.mostSamples, last.iterations + samplesLeft)
                                          : last.iterations + samplesLeft;

  // Rows have wall-clock times.
  const double timeOfTrial =
    tried.learningTime / std::max(1e-9, last.seconds) * (last.seconds - middle.seconds);
  const double secondsPerSample =
    iterations > 0. ? timeOfTrial / iterations : tried.learningTime / std::max(1., last.iterations);
  const double slower = slowdown(run.vertices) / slowdown(last.vertices);
  const double sizeOfFinish = std::max(1., run.vertices / trial.growth.back().vertices);
  estimate.seconds = trial.cloudTime + scale * tried.startTime + tried.learningTime +
    samplesLeft * slower * secondsPerSample + trial.finishTime * sizeOfFinish;
  return estimate;
}
}
