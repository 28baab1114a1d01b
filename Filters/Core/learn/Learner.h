// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "cloud/SampleStream.h"
#include "learn/FeatureStrength.h"
#include "learn/NeuralMesh.h"
#include "learn/NoiseFilter.h"
#include "learn/Parameters.h"
#include "learn/ThinParts.h"
#include "learn/TopologyLearning.h"
#include "learn/WinGain.h"

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

/// A mesh as it was learnt, with what learning knows of its vertices.
struct LearntMesh
{
  Mesh mesh; ///< no vertex of it is erased
  VertexProperty<double> activity;
  std::optional<VertexProperty<float>> featureStrength; ///< nothing unless it was asked for
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

  const Mesh& mesh() const { return neuralMesh_.mesh(); }
  const ActivityOrder& order() const { return neuralMesh_.order(); }
  const VertexGrid& grid() const { return neuralMesh_.grid(); }
  const RunCounts& counts() const { return counts_; }
  /// Distances between samples and winners, in units of the cloud; clipped where outliers are
  /// rejected.
  const MovingStatistics& sampleDistances() const { return noiseFilter_.distances(); }
  /// Changes of the winner's normal, delta_w of (8.1).
  const MovingStatistics& normalChanges() const { return winGain_.normalChanges(); }
  /// A copy of the mesh, whose vertices have their activities as properties.
  LearntMesh learntMesh() const;

  bool hasAllVertices() const { return neuralMesh_.vertexCount() >= parameters_.numberOfVertices; }
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
  void compact() { neuralMesh_.compact(executor_); }

  /// Writes all that has been learnt, or reads it into a learner that was made alike: the same cloud,
  /// parameters, weights and mesh. Then it goes on to the same bytes as the one that was written.
  void exchange(Archive& archive);

private:
  void learnBatch(std::size_t size);
  void findWinners(std::span<const Vector4> samples);
  void basicStep(Vector4 sample, VertexIndex winner);
  /// Whether nothing is to be learnt of a sample so far from its winner.
  bool isOutlier(VertexIndex winner, float squaredDistance) const;
  double gainOfMove(VertexIndex winner, Vector4 position);
  /// Takes the distances to a first mesh before it moves: outliers would pull at it at once.
  void observeFirstMesh();

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
  void enterList();

  bool isTopologyDue() const { return counts_.iterations >= nextTopology_; }
  void learnTopology();
  std::uint64_t topologyInterval() const; ///< in iterations
  bool removeStar(VertexIndex v);
  void count(const TopologyLearning::Result& result);

  void updateDecay();

  Parameters parameters_;
  const Executor& executor_;
  NeuralMesh neuralMesh_;
  SampleStream samples_;
  NoiseFilter noiseFilter_;
  WinGain winGain_;
  /// None where learning has started from a tetrahedron: its sides are no layers yet.
  ThinParts thinParts_;
  /// Since the last removal. Nothing where noise is filtered.
  std::optional<VertexProperty<std::uint8_t>> hasWon_;
  std::optional<FeatureStrength> featureStrength_;
  std::optional<TopologyLearning> topology_;
  BoundarySmoothing boundarySmoothing_ = BoundarySmoothing::Along;
  RunCounts counts_;
  std::vector<VertexIndex> winners_; ///< of the samples of a batch
  std::function<void(Step)> watch_;
  double decay_ = 1.;
  bool wanders_ = false;
  bool isListDue_ = false; ///< as soon as the mesh is large enough
  std::uint64_t nextAddition_ = 0;
  std::uint64_t nextRemoval_ = 0; ///< iteration; number of additions if noise is filtered
  std::uint64_t nextTopology_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t samplesAfterGrowth_ = 0;
};
}
