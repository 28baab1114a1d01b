// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/MovingStatistics.h"
#include "cloud/PointCloud.h"
#include "cloud/SampleStream.h"
#include "cloud/VertexGrid.h"
#include "learn/ActivityOrder.h"
#include "learn/FeatureStrength.h"
#include "learn/Parameters.h"
#include "learn/TopologyLearning.h"
#include "learn/WinGain.h"
#include "mesh/Mesh.h"
#include "mesh/Smoothing.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
class Archive;

/// What has happened in a run so far.
struct RunCounts
{
  std::uint64_t iterations = 0;
  std::uint64_t rejectedSamples = 0;
  std::uint64_t additions = 0;
  std::uint64_t removals = 0;
  std::uint64_t flips = 0;
  std::uint64_t illegalOperations = 0; ///< splits and collapses that were due, but not legal
  std::uint64_t removedTriangles = 0;
  std::uint64_t mergedBoundaries = 0; ///< pairs
  std::uint64_t filledBoundaries = 0;

  template <typename Archive>
  void exchange(Archive& archive)
  {
    archive(iterations, rejectedSamples, additions, removals, flips);
    archive(illegalOperations, removedTriangles, mergedBoundaries);
    archive(filledBoundaries);
  }
};

/// The steps of an iteration.
enum class Step
{
  Basic,
  NodeAddition,
  NodeRemoval,
  TopologyLearning
};

/// The Neural Mesh algorithm: a mesh that grows and moves towards samples of a cloud. Here is the
/// algorithm itself, for all variants; when to end a run is for StoppingRules to say.
class Learner
{
public:
  /// Starts from `mesh`, in the coordinates of `cloud`, which must outlive the learner, as the
  /// executor must. `order` holds the vertices of the mesh.
  Learner(const PointCloud& cloud, const Parameters& parameters, Mesh mesh,
    std::unique_ptr<ActivityOrder> order, const Executor& executor = Executor::sequential());
  /// Starts from `mesh` with exact counters, as if each vertex had just won once; with the list,
  /// the counters are dropped as soon as the mesh is large enough. Samples are drawn in proportion
  /// to `weights`, one for each point, instead of those of the cloud, if there are any.
  Learner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh,
    std::span<const float> weights = {}, const Executor& executor = Executor::sequential());
  /// Starts from a tetrahedron in the middle of the cloud.
  Learner(const PointCloud& cloud, const Parameters& parameters,
    const Executor& executor = Executor::sequential());

  /// Learns so many samples, batch by batch, and calls `afterBatch`, if it is a function, after
  /// each. Ends early once all is learnt.
  void learn(std::uint64_t sampleCount, const std::function<void()>& afterBatch = {});

  /// Has `watch` called when a step begins, for a stop watch; of Basic only when it follows another.
  void watchSteps(std::function<void(Step)> watch) { watch_ = std::move(watch); }

  /// Samples in a batch, at the present size of the mesh.
  std::size_t batchSize() const;

  const Mesh& mesh() const { return mesh_; }
  const ActivityOrder& order() const { return *order_; }
  const RunCounts& counts() const { return counts_; }
  /// Distances between samples and winners, in units of the cloud; clipped where outliers are
  /// rejected.
  const MovingStatistics& sampleDistances() const { return sampleDistances_; }
  /// Changes of the winner's normal, delta_w of (8.1).
  const MovingStatistics& normalChanges() const { return winGain_.normalChanges(); }
  /// Nothing unless it was asked for.
  const std::optional<FeatureStrength>& featureStrength() const { return featureStrength_; }
  const VertexGrid& grid() const { return grid_; }

  bool hasAllVertices() const { return mesh_.vertexCount() >= parameters_.numberOfVertices; }
  /// Samples that are left to be learnt once the mesh has all its vertices, without growth: those
  /// that feature strength takes.
  std::uint64_t samplesAfterGrowth() const { return samplesAfterGrowth_; }
  /// Whether there is nothing left to learn.
  bool isComplete() const { return hasAllVertices() && samplesAfterGrowth_ == 0 && !wanders_; }

  /// Has it go on once the mesh has all its vertices: then the laziest ones go where the mesh is
  /// busiest, for as long as anybody likes. In the noise-filtering variant with exact counters.
  void letWander() { wanders_ = true; }
  /// Goes on with another cloud than `from`, in the coordinates of that, and with its number of
  /// vertices and seed; it must outlive the learner. No topology is learnt then.
  void changeCloud(const PointCloud& from, const PointCloud& to, const Parameters& parameters);

  /// Vertices in Morton order without gaps, in all structures.
  void renumber();

  /// Writes all that has been learnt, or reads it into a learner that was made alike: the same cloud,
  /// parameters, weights and mesh. Then it goes on to the same bytes as the one that was written.
  void exchange(Archive& archive);

private:
  void learnBatch(std::size_t size);
  /// After growth: what lies side by side in space is to lie side by side in memory.
  void tidy();
  void findWinners(std::span<const Vector4> samples);
  void prefetchAhead(std::size_t sample) const;
  void prepareNoiseFilter(std::size_t batchSize);
  /// Takes the distances to a first mesh before it moves: outliers would pull at it at once.
  void observeFirstMesh();
  void observe(float squaredDistance);

  void basicStep(Vector4 sample, VertexIndex winner);
  void moveVertex(VertexIndex v, Vector4 position)
  {
    grid_.move(v, mesh_.position(v), position);
    mesh_.setPosition(v, position);
  }
  double measureMove(VertexIndex winner, Vector4 position);
  void smoothNeighbors(VertexIndex winner);

  bool isGrowthDue() const { return isAdditionDue() || isRemovalDue() || isTopologyDue(); }
  void grow();
  void begin(Step step) const;
  double patience() const; ///< by which C_vs is multiplied now
  bool isAdditionDue() const { return counts_.iterations >= nextAddition_; }
  void nodeAddition();
  void wander();
  bool isRemovalDue() const
  {
    return (parameters_.filtersNoise() ? counts_.additions : counts_.iterations) >= nextRemoval_;
  }
  std::uint64_t removalInterval() const; ///< in iterations (basic), additions (noise filtering)
  void nodeRemoval();
  void removeIdleVertices();
  void removeVertices();
  bool removeVertex(VertexIndex v);
  void enterListIfDue();
  void enterList(std::span<const VertexIndex> laziestFirst);

  bool isTopologyDue() const { return counts_.iterations >= nextTopology_; }
  void learnTopology();
  std::uint64_t topologyInterval() const; ///< in iterations
  bool removeStar(VertexIndex v);
  void follow(const TopologyLearning::Result& result);

  void updateDecay();

  std::vector<VertexIndex> vertices() const;
  void reserve();
  void makeGrid();
  void exchangeOrder(Archive& archive);

  Parameters parameters_;
  const Executor& executor_;
  Mesh mesh_;
  VertexGrid grid_;
  std::unique_ptr<ActivityOrder> order_;
  SampleStream samples_;
  std::optional<TopologyLearning> topology_;
  MovingStatistics sampleDistances_;
  RunCounts counts_;
  Vector4 boxMin_;
  Vector4 boxMax_;

  std::vector<VertexIndex> winners_;
  std::array<Vector4, Ring::Capacity> smoothedPositions_;
  std::vector<std::uint8_t> hasWon_; ///< since the last removal; not if noise is filtered
  BoundarySmoothing boundarySmoothing_ = BoundarySmoothing::Along;
  WinGain winGain_;
  std::optional<FeatureStrength> featureStrength_;
  std::function<void(Step)> watch_;
  double decay_ = 1.;
  float filterThreshold_ = 0.f; ///< epsilon_t of (9.2)
  float observationLimit_ = 0.f;
  float squaredRejectionLimit_ = 0.f;
  bool wanders_ = false;
  bool isListDue_ = false; ///< as soon as the mesh is large enough
  std::size_t observationStride_ = 1;
  std::size_t untilObservation_ = 0;
  std::uint64_t nextAddition_ = 0;
  std::uint64_t nextRemoval_ = 0; ///< iteration; number of additions if noise is filtered
  std::uint64_t nextTopology_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t samplesAfterGrowth_ = 0;
  std::size_t nextRenumbering_ = 0;
  std::size_t capacity_ = 0; ///< indices for which there is memory
};
}
