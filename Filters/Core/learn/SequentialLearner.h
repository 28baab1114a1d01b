// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/SampleStream.h"
#include "learn/FeatureStrength.h"
#include "learn/Learner.h"
#include "learn/NeuralMesh.h"
#include "learn/ThinParts.h"
#include "learn/TopologyLearning.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The Neural Mesh algorithm for all variants, one sample after the other.
class SequentialLearner final : public Learner
{
public:
  /// Starts from `mesh`, in the coordinates of `cloud`, which must outlive the learner, as the
  /// executor must. `order` holds the vertices of the mesh.
  SequentialLearner(const PointCloud& cloud, const Parameters& parameters, Mesh mesh,
    std::unique_ptr<ActivityOrder> order, const Executor& executor = Executor::sequential());
  /// Starts from `mesh` with exact counters, as if each vertex had just won once; with the list,
  /// the counters are dropped as soon as the mesh is large enough. Samples are drawn in proportion
  /// to `weights`, one for each point, instead of those of the cloud, if there are any.
  SequentialLearner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh,
    std::span<const float> weights = {}, const Executor& executor = Executor::sequential());
  /// Starts from a tetrahedron in the middle of the cloud.
  SequentialLearner(const PointCloud& cloud, const Parameters& parameters,
    const Executor& executor = Executor::sequential());

  std::size_t batchSize() const override;

  const Mesh& mesh() const override { return neuralMesh_.mesh(); }
  const ActivityOrder& order() const { return neuralMesh_.order(); }
  const VertexGrid& grid() const { return neuralMesh_.grid(); }
  LearntMesh learntMesh() const override;

  void changeCloud(
    const PointCloud& from, const PointCloud& to, const Parameters& parameters) override;
  void compact() override { neuralMesh_.compact(executor_); }
  void exchange(Archive& archive) override;

private:
  void learnBatch(std::size_t size) override;
  void findWinners(std::span<const Vector4> samples);
  void basicStep(Vector4 sample, VertexIndex winner);
  /// Whether nothing is to be learnt of a sample so far from its winner.
  bool isOutlier(VertexIndex winner, float squaredDistance) const;
  double gainOfMove(VertexIndex winner, Vector4 position);
  /// Takes the distances to a first mesh before it moves: outliers would pull at it at once.
  void observeFirstMesh();

  bool isGrowthDue() const { return isAdditionDue() || isRemovalDue() || isTopologyDue(); }
  void grow();
  bool isAdditionDue() const { return counts_.iterations >= nextAddition_; }
  void nodeAddition();
  void wander();
  bool isRemovalDue() const
  {
    return (parameters_.filtersNoise() ? counts_.additions : counts_.iterations) >= nextRemoval_;
  }
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

  NeuralMesh neuralMesh_;
  SampleStream samples_;
  /// None where learning has started from a tetrahedron: its sides are no layers yet.
  ThinParts thinParts_;
  /// Since the last removal. Nothing where noise is filtered.
  std::optional<VertexProperty<std::uint8_t>> hasWon_;
  std::optional<FeatureStrength> featureStrength_;
  std::optional<TopologyLearning> topology_;
  BoundarySmoothing boundarySmoothing_ = BoundarySmoothing::Along;
  std::vector<VertexIndex> winners_; ///< of the samples of a batch
  bool isListDue_ = false;           ///< as soon as the mesh is large enough
  std::uint64_t nextTopology_ = std::numeric_limits<std::uint64_t>::max();
};
}
