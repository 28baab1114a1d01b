// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LargePageAllocator.h"
#include "cloud/PackedGrid.h"
#include "cloud/StratifiedSamples.h"
#include "cloud/VertexGrid.h"
#include "learn/Learner.h"
#include "learn/Reservations.h"
#include "mesh/VertexSplit.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Algorithm 4, noise filtering, with its loop turned inside out: all samples of a batch, which is half as large as
/// the mesh, are learnt at once. Each phase is a loop over samples or vertices in which each depends on what was there
/// before the phase alone, and writes what is its own: so it runs on all threads, and gives the same bytes on any
/// number of them.
///
/// What differs from one sample after the other: winners are those of the mesh as it was when the batch began; a vertex
/// is smoothed once for all wins of its neighbours; and of the splits and collapses that are due, those are made
/// together that lie apart.
///
/// A mesh grows to a quarter of its vertices first. If that resolves the shape, each of its triangles is made four, and
/// growth goes on from there: that takes a third of the samples.
class ParallelLearner final : public Learner
{
public:
  /// Whether it has all that is asked for: a large mesh by the noise-filtering variant with exact counters, as its
  /// defaults have it, without topology learning or feature strength.
  static bool isFor(const Parameters& parameters);

  /// Starts from `mesh`, in the coordinates of `cloud`, as if each vertex had just won once. See Learner::from().
  ParallelLearner(const PointCloud& cloud, const Parameters& parameters, const Mesh& mesh,
    std::span<const float> weights = {}, const Executor& executor = Executor::sequential());

  std::size_t batchSize() const override;
  const Mesh& mesh() const override { return mesh_; }
  LearntMesh learntMesh() const override;
  void changeCloud(
    const PointCloud& from, const PointCloud& to, const Parameters& parameters) override;
  void compact() override;
  void exchange(Archive& archive) override;

private:
  /// A split or a collapse that may be made.
  struct Operation
  {
    Reservations::Request request;
    std::optional<VertexSplit> split;
    VertexIndex other = NoVertex; ///< the new vertex; that into which one is collapsed
    unsigned flips = 0;
  };
  /// What a turn of growth is to do.
  struct Quota
  {
    std::uint64_t splits = 0;
    std::uint64_t collapses = 0;
    double mostCollapses = 0.; ///< beyond the laziest ones, idle ones go up to that number
    std::uint64_t interval = 1;
  };

  void learnBatch(std::size_t size) override;
  void endBatch() override;
  /// A batch, without growth.
  void findWinners(std::size_t size);
  void takeSamples();
  void smooth();
  void observe();
  VertexIndex facingWinner(Vector4 sample, VertexIndex closest) const;
  void observeFirstMesh();

  // Growth
  void grow();
  Quota quota() const;
  std::uint64_t intervalOfRemovals() const;
  void select(const Quota& quota);
  std::uint64_t keyOfRank(bool isSplit, double rank);
  void plan();
  void commit(const Quota& quota);
  void make();

  // From coarse to fine
  std::size_t verticesOfStage() const;
  bool isResolved() const;
  std::vector<Vector4> normals() const;
  void subdivideAll();
  void sortAlongCurve(Mesh& mesh, const Executor& executor) const;
  void tidy();
  void noteCompact();

  void lookForThinParts();
  void makeGrid();
  VertexIndex closestTo(Vector4 point) const;
  void reserve(std::size_t added);
  void tidyIfGrown();

  Mesh mesh_;
  VertexProperty<float> activity_;      ///< tau
  VertexProperty<std::uint8_t> isThin_; ///< where another layer is near; see ThinParts
  bool hasThinParts_ = false;
  bool isCoarse_ = false;    ///< until each triangle is made four
  std::size_t nextLook_ = 0; ///< at thin parts: number of vertices
  Vector4 boxMin_, boxMax_;
  StratifiedSamples samples_;
  PackedGrid grid_;
  std::optional<VertexGrid> crowds_; ///< instead, where vertices crowd
  Reservations reservations_;
  std::size_t nextRenumbering_ = 0; ///< number of vertices
  std::size_t reserved_ = 0;        ///< indices for which there is memory
  std::array<float, 64> rates_{};   ///< of smoothing, by the number of wins around

  // Of a batch
  LargeVector<Vector4> batch_;
  LargeVector<std::uint32_t> nextWon_;  ///< sample of the same winner
  LargeVector<std::uint32_t> firstWon_; ///< of each vertex
  LargeVector<Vector4> moved_;
  LargeVector<std::uint8_t> wins_;
  std::vector<VertexIndex> observed_;                     ///< winners of every so-many-th sample
  std::vector<float> observedDistances_;                  ///< squared
  std::vector<std::vector<Reservations::Request>> found_; ///< by part
  std::vector<Reservations::Request> requests_;
  std::vector<Operation> operations_;
  std::vector<std::uint64_t> someKeys_;
};
}
