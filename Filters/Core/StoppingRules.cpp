// SPDX-License-Identifier: BSD-3-Clause
#include "StoppingRules.h"

#include "Archive.h"
#include "CloudDistance.h"

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
  if (this->parameters_.maximumIterations > 0 && iterations >= this->parameters_.maximumIterations)
  {
    return StopReason::Iterations;
  }
  if (this->parameters_.targetSampleDistance > 0. && learner.sampleDistances().isFull() &&
    learner.sampleDistances().mean() <=
      this->parameters_.targetSampleDistance * this->cloud_.diagonal())
  {
    return StopReason::SampleDistance;
  }
  if (this->meetsCloudDistance(learner))
  {
    return StopReason::CloudDistance;
  }
  if (this->parameters_.targetNormalChange > 0. && learner.normalChanges().isFull() &&
    learner.normalChanges().mean() <= this->parameters_.targetNormalChange)
  {
    return StopReason::NormalChange;
  }
  if (this->parameters_.timeLimit > 0. && this->seconds() >= this->parameters_.timeLimit)
  {
    return StopReason::TimeLimit;
  }
  if (vertices > this->mostVertices_)
  {
    this->mostVertices_ = vertices;
    this->lastGrowth_ = iterations;
  }
  const double patience =
    this->parameters_.stallPatience * double(std::max(this->mostVertices_, LeastVerticesForStall));
  if (!learner.hasAllVertices() && double(iterations - this->lastGrowth_) > patience)
  {
    return StopReason::Stalled;
  }
  return StopReason::None;
}

double StoppingRules::progress(const Learner& learner)
{
  const double first = this->samplesUntil(this->firstVertices_);
  const double last = this->samplesUntil(std::size_t(this->parameters_.numberOfVertices));
  // All samples after growth are left as long as the mesh grows.
  const double left = double(learner.samplesAfterGrowth());
  this->samplesAfterGrowth_ = std::max(this->samplesAfterGrowth_, left);
  double done =
    (this->samplesUntil(learner.mesh().vertexCount()) - first + this->samplesAfterGrowth_ - left) /
    std::max(1., last - first + this->samplesAfterGrowth_);
  if (this->parameters_.maximumIterations > 0)
  {
    done = std::max(
      done, double(learner.counts().iterations) / double(this->parameters_.maximumIterations));
  }
  if (this->parameters_.timeLimit > 0.)
  {
    done = std::max(done, this->seconds() / this->parameters_.timeLimit);
  }
  this->progress_ = std::clamp(done, this->progress_, 1.);
  return this->progress_;
}

double StoppingRules::samplesUntil(std::size_t vertices) const
{
  const double early = std::min(double(vertices), double(this->parameters_.earlyVertices));
  return double(this->parameters_.samplesPerAddition) *
    (double(vertices) + early * (this->parameters_.earlyPatience - 1.));
}

double StoppingRules::seconds() const
{
  return std::chrono::duration<double>(Clock::now() - this->start_).count();
}

void StoppingRules::exchange(Archive& archive)
{
  double seconds = this->seconds();
  archive(seconds, this->mostVertices_, this->lastGrowth_, this->nextCloudDistance_);
  archive(this->samplesAfterGrowth_, this->progress_);
  archive.require(seconds >= 0. && seconds <= MostSeconds);
  if (archive.isReading())
  {
    this->start_ = Clock::now() -
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
}

bool StoppingRules::meetsCloudDistance(const Learner& learner)
{
  const std::size_t vertices = learner.mesh().vertexCount();
  if (!(this->parameters_.targetCloudDistance > 0.) || vertices < this->nextCloudDistance_)
  {
    return false;
  }
  this->nextCloudDistance_ = std::size_t(GrowthUntilCloudDistance * double(vertices)) + 1;
  const double distance = meanDistanceToSurface(
    this->cloud_.points(), learner.mesh(), learner.grid(), PointsForCloudDistance);
  return distance <= this->parameters_.targetCloudDistance * this->cloud_.diagonal();
}
}
