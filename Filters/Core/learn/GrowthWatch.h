// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/Learner.h"
#include "mesh/TriangleMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace neuralmesh
{
/// The mesh at a moment of its growth, compactly: 40 bytes a vertex where it is closed.
struct GrowthSnapshot
{
  /// In the coordinates of the input, oriented outwards.
  TriangleMesh mesh() const;

  std::vector<std::array<float, 3>> points; ///< in units of the cloud
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> activities;
  std::uint64_t iterations = 0;
  // How the cloud lies in the input.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double unit = 1.;
};

/// Somebody who watches a mesh grow: `take` gets `snapshots` of them at most, the first one before
/// learning. No watch changes the result.
struct GrowthWatch
{
  std::size_t snapshots = 0;
  std::function<void(GrowthSnapshot)> take;
};

/// Takes the snapshots of a run. The numbers of vertices of the first one, of all others and of the
/// result form a geometric series, as far as the batches of the learner and whole numbers let them;
/// they always rise, but for a result that was simplified to fewer vertices than were learnt. A run that
/// ends early has fewer.
class GrowthRecorder
{
public:
  /// All must outlive the recorder.
  GrowthRecorder(const GrowthWatch& watch, const Learner& learner, const PointCloud& cloud,
    std::size_t vertices);

  /// Takes a snapshot if one is due: to be called after each batch.
  void takeIfDue();

private:
  const GrowthWatch& watch_;
  const Learner& learner_;
  const PointCloud& cloud_;
  double first_;
  double growth_; ///< in vertices, from each snapshot to the next
  std::size_t next_;
};
}
