// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/MovingStatistics.h"
#include "cloud/PointCloud.h"
#include "learn/NoiseFilter.h"
#include "learn/Parameters.h"
#include "learn/WinGain.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

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
  std::optional<VertexProperty<float>> uncertainty{};   ///< likewise, and told in the end
};

/// The Neural Mesh algorithm: a mesh that grows and moves towards samples of a cloud. When to end a run
/// is for StoppingRules to say.
///
/// There are two of it. SequentialLearner takes one sample after the other, as the thesis has it, in all
/// variants. ParallelLearner takes all samples of a batch at once, on all threads, for the variant that
/// is the default.
class Learner
{
public:
  /// The parallel one where it has what the parameters ask for, else the sequential one. Starts from
  /// `mesh`, in the coordinates of `cloud`, which must outlive the learner, as the executor must. Samples
  /// are drawn in proportion to `weights`, one for each point, instead of those of the cloud, if there
  /// are any.
  static std::unique_ptr<Learner> from(const Mesh& mesh, std::span<const float> weights,
    const PointCloud& cloud, const Parameters& parameters, const Executor& executor);

  virtual ~Learner() = default;
  Learner(const Learner&) = delete;
  Learner& operator=(const Learner&) = delete;

  /// Learns so many samples, batch by batch, and calls `afterBatch`, if it is a function, after
  /// each. Ends early once all is learnt.
  void learn(std::uint64_t sampleCount, const std::function<void()>& afterBatch = {});
  /// Learns what learn() has left, as its executor was interrupted, to the same bytes as without that.
  void finishTurn(const std::function<void()>& afterBatch = {});

  /// Has `watch` called when a step begins, for a stop watch; of Basic only when it follows another.
  void watchSteps(std::function<void(Step)> watch) { watch_ = std::move(watch); }

  /// Samples in a batch, at the present size of the mesh.
  virtual std::size_t batchSize() const = 0;

  virtual const Mesh& mesh() const = 0;
  const RunCounts& counts() const { return counts_; }
  /// Distances between samples and winners, in units of the cloud; clipped where outliers are
  /// rejected.
  const MovingStatistics& sampleDistances() const { return noiseFilter_.distances(); }
  /// Changes of the winner's normal, delta_w of (8.1).
  const MovingStatistics& normalChanges() const { return winGain_.normalChanges(); }
  /// A copy of the mesh, whose vertices have their activities as properties.
  virtual LearntMesh learntMesh() const = 0;

  bool hasAllVertices() const { return mesh().vertexCount() >= parameters_.numberOfVertices; }
  /// Samples that are left to be learnt once the mesh has all its vertices, without growth: those
  /// that feature strength takes, or that let new vertices find their places.
  std::uint64_t samplesAfterGrowth() const { return samplesAfterGrowth_; }
  /// Whether there is nothing left to learn.
  bool isComplete() const { return hasAllVertices() && samplesAfterGrowth_ == 0 && !wanders_; }

  /// Has it go on once the mesh has all its vertices: then the laziest ones go where the mesh is
  /// busiest, for as long as anybody likes. In the noise-filtering variant with exact counters.
  void letWander() { wanders_ = true; }
  /// Goes on with another cloud than `from`, in the coordinates of that, and with its number of
  /// vertices and seed; it must outlive the learner. No topology is learnt then.
  virtual void changeCloud(
    const PointCloud& from, const PointCloud& to, const Parameters& parameters) = 0;

  /// Vertices in Morton order without gaps, in all structures.
  virtual void compact() = 0;

  /// Writes all that has been learnt, or reads it into a learner that was made alike: the same cloud,
  /// parameters, weights and mesh. Then it goes on to the same bytes as the one that was written.
  virtual void exchange(Archive& archive) = 0;

protected:
  Learner(const Parameters& parameters, const Executor& executor);
  Learner(Learner&&) = default;

  virtual void learnBatch(std::size_t size) = 0;
  /// What comes after a batch and may be interrupted: then it has changed nothing, and is called again.
  virtual void endBatch() {}
  void begin(Step step) const;

  /// By which C_vs is multiplied now.
  double patience() const;
  /// C_nr additions; in the basic variant n C_ec samples.
  std::uint64_t removalInterval() const;
  /// alpha_n^(C_ec n), with alpha_n of (9.4): that of a vertex which has won once, C_ec n samples ago.
  double idleActivity() const;
  /// A multiple of that of all if they won equally often: chance has the most active of a million at less.
  double busyActivity() const;
  void updateDecay();

  Parameters parameters_;
  const Executor& executor_;      ///< without interruption
  const Executor& interruptible_; ///< for endBatch()
  NoiseFilter noiseFilter_;
  WinGain winGain_;
  RunCounts counts_;
  std::function<void(Step)> watch_;
  double decay_ = 1.;
  bool wanders_ = false;
  std::uint64_t nextAddition_ = 0;
  std::uint64_t nextRemoval_ = 0; ///< iteration; number of additions if noise is filtered
  std::uint64_t samplesAfterGrowth_ = 0;
  std::uint64_t endOfTurn_ = 0; ///< in iterations
  bool isBatchOpen_ = false;    ///< until its end is complete
};
}
