// SPDX-License-Identifier: BSD-3-Clause
#include "learn/StoppingRules.h"

#include "base/Archive.h"
#include "cloud/CloudDistance.h"
#include "cloud/PlaceOnMesh.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// The distance from cloud to mesh is measured whenever the mesh has grown by a tenth.
constexpr std::size_t FirstCloudDistance = 50;
constexpr double GrowthUntilCloudDistance = 1.1;
constexpr std::size_t PointsForCloudDistance = 4096;

/// Vertices that a smaller mesh counts as when it is judged whether it has stalled.
constexpr std::size_t LeastVerticesForStall = 100;

/// As many as a clock can hold.
constexpr double MostSeconds = 1e9;
}

std::string_view name(StopReason reason)
{
  switch (reason)
  {
    case StopReason::None:
      return "none";
    case StopReason::Vertices:
      return "vertices";
    case StopReason::Iterations:
      return "iterations";
    case StopReason::SampleDistance:
      return "sample distance";
    case StopReason::CloudDistance:
      return "cloud distance";
    case StopReason::NormalChange:
      return "normal change";
    case StopReason::TimeLimit:
      return "time limit";
    case StopReason::Stalled:
      return "stalled";
    case StopReason::Cancelled:
      return "cancelled";
  }
  return "";
}

bool mayEndBeforeVertices(const Parameters& parameters)
{
  return parameters.timeLimit > 0. || parameters.maximumIterations > 0 ||
    parameters.targetSampleDistance > 0. || parameters.targetCloudDistance > 0. ||
    parameters.targetNormalChange > 0.;
}

StoppingRules::StoppingRules(
  const PointCloud& cloud, const Parameters& parameters, std::size_t firstVertices)
  : cloud_(cloud)
  , parameters_(parameters)
  , firstVertices_(firstVertices)
  , nextCloudDistance_(FirstCloudDistance)
{
}

StopReason StoppingRules::check(const Learner& learner)
{
  const std::uint64_t iterations = learner.counts().iterations;
  const std::size_t vertices = learner.mesh().vertexCount();
  if (learner.isComplete())
  {
    return StopReason::Vertices;
  }
  if (parameters_.maximumIterations > 0 && iterations >= parameters_.maximumIterations)
  {
    return StopReason::Iterations;
  }
  if (parameters_.targetSampleDistance > 0. && learner.sampleDistances().isFull() &&
    learner.sampleDistances().mean() <= parameters_.targetSampleDistance * cloud_.diagonal())
  {
    return StopReason::SampleDistance;
  }
  if (meetsCloudDistance(learner))
  {
    return StopReason::CloudDistance;
  }
  if (parameters_.targetNormalChange > 0. && learner.normalChanges().isFull() &&
    learner.normalChanges().mean() <= parameters_.targetNormalChange)
  {
    return StopReason::NormalChange;
  }
  if (parameters_.timeLimit > 0. && seconds() >= parameters_.timeLimit)
  {
    return StopReason::TimeLimit;
  }
  if (vertices > mostVertices_)
  {
    mostVertices_ = vertices;
    lastGrowth_ = iterations;
  }
  const double patience =
    parameters_.stallPatience * double(std::max(mostVertices_, LeastVerticesForStall));
  if (!learner.hasAllVertices() && double(iterations - lastGrowth_) > patience)
  {
    return StopReason::Stalled;
  }
  return StopReason::None;
}

double StoppingRules::progress(const Learner& learner)
{
  const double first = samplesUntil(firstVertices_);
  const double last = samplesUntil(std::size_t(parameters_.numberOfVertices));
  // All samples after growth are left as long as the mesh grows.
  const double left = double(learner.samplesAfterGrowth());
  samplesAfterGrowth_ = std::max(samplesAfterGrowth_, left);
  double done = (samplesUntil(learner.mesh().vertexCount()) - first + samplesAfterGrowth_ - left) /
    std::max(1., last - first + samplesAfterGrowth_);
  if (parameters_.maximumIterations > 0)
  {
    done =
      std::max(done, double(learner.counts().iterations) / double(parameters_.maximumIterations));
  }
  if (parameters_.timeLimit > 0.)
  {
    done = std::max(done, seconds() / parameters_.timeLimit);
  }
  progress_ = std::clamp(done, progress_, 1.);
  return progress_;
}

double StoppingRules::samplesUntil(std::size_t vertices) const
{
  const double early = std::min(double(vertices), double(parameters_.earlyVertices));
  return double(parameters_.samplesPerAddition) *
    (double(vertices) + early * (parameters_.earlyPatience - 1.));
}

double StoppingRules::seconds() const
{
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void StoppingRules::exchange(Archive& archive)
{
  double elapsed = seconds();
  archive(elapsed, mostVertices_, lastGrowth_, nextCloudDistance_);
  archive(samplesAfterGrowth_, progress_);
  archive.require(elapsed >= 0. && elapsed <= MostSeconds);
  if (archive.isReading())
  {
    start_ = Clock::now() -
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(elapsed));
  }
}

bool StoppingRules::meetsCloudDistance(const Learner& learner)
{
  const std::size_t vertices = learner.mesh().vertexCount();
  if (!(parameters_.targetCloudDistance > 0.) || vertices < nextCloudDistance_)
  {
    return false;
  }
  nextCloudDistance_ = std::size_t(GrowthUntilCloudDistance * double(vertices)) + 1;
  const double distance = meanDistanceToSurface(
    cloud_.points(), learner.mesh(), gridOf(learner.mesh(), cloud_), PointsForCloudDistance);
  return distance <= parameters_.targetCloudDistance * cloud_.diagonal();
}
}
