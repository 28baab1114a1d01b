// SPDX-License-Identifier: BSD-3-Clause
#include "run/StreamingReconstruction.h"

#include "run/Stages.h"
#include "run/Warnings.h"
#include "start/OccupiedVoxels.h"
#include "start/OutlierClusters.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
/// With fewer points there is no mesh yet.
constexpr std::size_t LeastPointsToMesh = 100;
/// Number of samples between two looks at the clock.
constexpr std::uint64_t SamplesPerLook = 20000;

/// A new mesh starts if the part of the occupied space beyond the mesh has grown by so much since
/// its start ...
constexpr double MostUncovered = 0.02;
/// ... or if there are so many times the points of its start.
constexpr std::size_t MorePoints = 2;

/// The voxels of the occupied space are about an edge wide, but wide enough for so many points
/// each, and within these resolutions.
constexpr double PointsPerVoxel = 36.;
constexpr double CoarsestCover = 4., FinestCover = 32.;

/// The part of the space occupied by a cloud that is farther than a voxel from all vertices of a
/// mesh. The mesh is in the coordinates of another cloud.
double uncoveredPart(const PointCloud& cloud, const Mesh& mesh, const PointCloud& ofMesh)
{
  const double edge = mesh.meanEdge() * ofMesh.unit() / cloud.unit();
  const double wanted =
    std::min(1. / edge, std::sqrt(double(cloud.points().size()) / PointsPerVoxel));
  const OccupiedVoxels voxels =
    occupiedVoxels(cloud, unsigned(std::clamp(wanted, CoarsestCover, FinestCover)));
  const VoxelGrid& grid = voxels.grid;
  std::vector<std::uint8_t> isCovered(grid.size() + 1, 0); // the last one for all places outside
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (!mesh.isAlive(v))
    {
      continue;
    }
    const Eigen::Vector3d place = cloud.fromInput(ofMesh.toInput(mesh.position(v))).toDouble();
    for (int x = -1; x <= 1; ++x)
    {
      for (int y = -1; y <= 1; ++y)
      {
        for (int z = -1; z <= 1; ++z)
        {
          isCovered[grid.voxelAt(place + grid.width * Eigen::Vector3d(x, y, z))] = 1;
        }
      }
    }
  }
  double occupied = 0., uncovered = 0.;
  for (std::size_t voxel = 0; voxel < grid.size(); ++voxel)
  {
    occupied += voxels.isOccupied[voxel] ? 1. : 0.;
    uncovered += voxels.isOccupied[voxel] && !isCovered[voxel] ? 1. : 0.;
  }
  return occupied > 0. ? uncovered / occupied : 0.;
}
}

std::string StreamingReconstruction::errorOf(const Parameters& parameters)
{
  if (parameters.numberOfVertices == 0)
  {
    return "A stream needs a number of vertices: it is not found while points come.";
  }
  const bool isRight = parameters.variant == Variant::NoiseFiltering &&
    parameters.order == Order::Exact && !parameters.topologyLearning &&
    !parameters.computeFeatureStrength;
  return isRight ? ""
                 : "A stream is learnt in the noise-filtering variant with exact order only, and "
                   "neither topology nor feature strength are.";
}

StreamingReconstruction::StreamingReconstruction(
  const Parameters& parameters, std::size_t reservoirSize)
  : parameters_(parameters)
  , reservoir_(reservoirSize, parameters.seed)
{
  parameters_.curvatureDensity = 0.;
}

void StreamingReconstruction::addPoints(const PointSpans& points, const DirectionOf& directionOf)
{
  points.forEach(0, points.size(),
    [&](std::size_t index, const Eigen::Vector3d& point)
    {
      if (point.allFinite())
      {
        Eigen::Vector3f direction = Eigen::Vector3f::Zero();
        if (directionOf)
        {
          direction = directionOf(index).stableNormalized().cast<float>();
        }
        reservoir_.add(point, direction.allFinite() ? direction : Eigen::Vector3f::Zero());
      }
      else
      {
        ++droppedCount_;
      }
    });
}

void StreamingReconstruction::addPoints(const PointSpans& points, const OrientationHints& hints)
{
  const bool haveViews = hints.viewOf || hints.viewpoints.size() == 1;
  if (!haveViews && !hints.normalOf)
  {
    addPoints(points);
    return;
  }
  addPoints(points,
    [&](std::size_t index) -> Eigen::Vector3d
    {
      const auto point = std::uint32_t(index);
      const std::uint32_t view = hints.viewOf ? hints.viewOf(point) : 0;
      if (haveViews && view < hints.viewpoints.size())
      {
        return hints.viewpoints[view] - points[index];
      }
      return hints.normalOf ? hints.normalOf(point) : Eigen::Vector3d::Zero();
    });
}

std::uint64_t StreamingReconstruction::sampleCount() const
{
  return earlierSamples_ + (learner_ ? learner_->counts().iterations : 0);
}

std::size_t StreamingReconstruction::vertexCount() const
{
  return learner_ ? learner_->mesh().vertexCount() : 0;
}

std::uint64_t StreamingReconstruction::learn(std::uint64_t samples, const Progress& progress)
{
  if (!takeInPoints(progress))
  {
    return 0;
  }
  Learner& learner = *learner_;
  const std::uint64_t begin = learner.counts().iterations;
  for (std::uint64_t learnt = 0; learnt < samples && progress(double(learnt) / double(samples));
       learnt = learner.counts().iterations - begin)
  {
    learner.learn(std::min<std::uint64_t>(
      samples - learnt, std::max<std::uint64_t>(SamplesPerCheck, learner.batchSize())));
  }
  return learner.counts().iterations - begin;
}

std::uint64_t StreamingReconstruction::learnFor(double seconds, const Progress& progress)
{
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  bool goesOn = true;
  std::uint64_t all = 0, learnt = 0;
  do
  {
    learnt = learn(SamplesPerLook,
      [&](double)
      { return goesOn = progress(seconds > 0. ? std::min(1., passed() / seconds) : 1.); });
    all += learnt;
  } while (goesOn && learnt > 0 && passed() < seconds);
  return all;
}

/// Lets the mesh learn from the points that have arrived. Returns false if there is no mesh then.
bool StreamingReconstruction::takeInPoints(const Progress& progress)
{
  if (takenIn_ == reservoir_.seen() || reservoir_.points().size() < LeastPointsToMesh)
  {
    return hasMesh();
  }
  const bool hasDirections = !reservoir_.directions().empty();
  auto cloud =
    std::make_unique<PointCloud>(reservoir_.points(), std::span<const double>(), hasDirections);
  if (!cloud->hasExtent())
  {
    return hasMesh();
  }
  std::optional<PointCloud> withClusters;
  bool goesOn = true;
  const Progress ask = [&](double fraction) { return goesOn = goesOn && progress(fraction); };
  if (auto cleaned = parameters_.keepPieces > 0. ? withoutClusters(*cloud, ask) : std::nullopt)
  {
    withClusters = std::exchange(*cloud, std::move(*cleaned));
  }
  if (!goesOn)
  {
    return hasMesh();
  }
  Parameters parameters = learnable(parameters_, *cloud);
  parameters.seed += clouds_++;
  if (mustBegin(*cloud))
  {
    if (!beginAnew(*cloud, parameters, progress))
    {
      return false;
    }
  }
  else
  {
    learner_->changeCloud(*cloud_, *cloud, parameters);
    if (gaps_)
    {
      gaps_->bridgeWidth *= cloud_->unit() / cloud->unit();
    }
  }
  cloud_ = std::move(cloud);
  withClusters_ = std::move(withClusters);
  directions_ = reservoir_.directions();
  takenIn_ = reservoir_.seen();
  return true;
}

bool StreamingReconstruction::mustBegin(const PointCloud& cloud) const
{
  return !learner_ || cloud.points().size() >= MorePoints * pointsAtBeginning_ ||
    uncoveredPart(cloud, learner_->mesh(), *cloud_) > uncoveredAtBeginning_ + MostUncovered;
}

/// Starts a new mesh. Returns false if `progress` ended it: then nothing has changed.
bool StreamingReconstruction::beginAnew(
  const PointCloud& cloud, const Parameters& parameters, const Progress& progress)
{
  bool isEnded = false;
  Beginning beginning =
    begin(cloud, parameters, [&](double) { return !isEnded && !(isEnded = !progress(0.)); });
  if (isEnded)
  {
    return false;
  }
  earlierSamples_ = sampleCount();
  gaps_ = beginning.gaps;
  learner_ = learnerFrom(std::move(beginning), cloud, parameters);
  learner_->letWander();
  pointsAtBeginning_ = cloud.points().size();
  uncoveredAtBeginning_ = uncoveredPart(cloud, learner_->mesh(), cloud);
  ++beginnings_;
  return true;
}

Reconstruction StreamingReconstruction::mesh(
  bool isFinished, const Progress& progress, const OrientationHints& hints) const
{
  Reconstruction result;
  LearntMesh learnt = learner_->learntMesh();
  result.counts = learner_->counts();
  result.counts.iterations = sampleCount();
  if (isFinished && parameters_.fitRounds > 0)
  {
    const std::size_t vertices = learner_->hasAllVertices()
      ? std::size_t(parameters_.numberOfVertices)
      : learnt.mesh.vertexCount();
    const bool isTold = parameters_.computeUncertainty;
    const double endOfFit = isTold ? PartBeforeUncertainty : 1.;
    result.finish =
      finish(learnt, *cloud_, parameters_, gaps_, vertices, partOf(progress, 0., endOfFit));
    const bool isDone = result.finish &&
      (!isTold ||
        tellUncertainty(learnt, *cloud_, parameters_, result, partOf(progress, endOfFit, 1.)));
    result.stopReason = isDone ? StopReason::None : StopReason::Cancelled;
  }
  OrientationHints allHints{ hints.viewpoints, {}, {}, hints.up };
  if (!directions_.empty())
  {
    allHints.normalOf = [this](std::uint32_t point) { return directions_[point].cast<double>(); };
  }
  const bool isMeasured = isFinished && result.isComplete();
  const PointCloud& all = withClusters_ ? *withClusters_ : *cloud_;
  const Progress describing = partOf(progress, 1., 1.);
  describe(std::move(learnt), *cloud_, isMeasured ? &all : nullptr, allHints, result, describing);
  if (isMeasured &&
    (!result.quality ||
      !explainPoints(all, withClusters_ ? &*cloud_ : nullptr, parameters_.keepPieces, false, result,
        describing)))
  {
    result.stopReason = StopReason::Cancelled;
    result.quality.reset();
    result.explanation.reset();
    result.finish.reset();
  }
  result.warnings = warningsOf(result, all, parameters_);
  return result;
}
}
