// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/SequentialLearner.h"
#include "learn/StoppingRules.h"
#include "mesh/TriangleMesh.h"
#include "run/EnsembleParameters.h"
#include "start/VoxelMajority.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace neuralmesh
{
/// The members that this process learns if processes share the work: every `count`-th one from
/// `index` on.
struct EnsembleShare
{
  std::size_t index = 0;
  std::size_t count = 1;
};

/// The first two steps of Algorithm 5 (chapter 10): several meshes of one cloud with different
/// seeds, and the space that most of them fill. Members grow by the noise-filtering variant with
/// exact counters and the product's defaults, as spheres.
///
/// Threads may call functions of a member for different members at the same time. The result does
/// not depend on that, nor on how processes share the members. A member has its number among those
/// that this process learns.
class Ensemble
{
public:
  /// If the cloud has few points, members have fewer vertices: one triangle for every so many
  /// points.
  Ensemble(const PointCloud& cloud, const EnsembleParameters& parameters, EnsembleShare share = {});

  /// Number of voxels of the grid along each axis.
  static std::size_t gridCount(unsigned resolution);

  /// Number of members that this process learns.
  std::size_t size() const { return members_.size(); }

  /// Continues to learn for some milliseconds.
  void learn(std::size_t member);
  /// Whether all members are learnt or have stalled.
  bool isLearnt() const;
  /// The part of learning that is done, 0 to 1.
  double progress() const;
  /// A member as it is now, in the coordinates of the cloud.
  const Mesh& mesh(std::size_t member) const { return members_[member]->learner.mesh(); }
  /// The same without gaps in its indices, so that a learner can start from it.
  const Mesh& renumberedMesh(std::size_t member);
  /// About the number of samples that all members of this process will have drawn in the end.
  double expectedSamples() const;

  // The steps after all members are learnt, in this order:

  /// Finds the phantoms of a member.
  void findPhantoms(std::size_t member);
  /// The boxes of all members: for each member of all shares the least and the largest x, y and z,
  /// in the coordinates of the input; 0 if another process learns it.
  std::vector<double> boxes() const;
  /// Makes the grid in which members are compared, from the sum of the boxes of all shares: a cube
  /// around the space that most members can fill.
  void makeGrid(const std::vector<double>& boxes);
  /// Finds the voxels of a member.
  void voxelize(std::size_t member);
  /// The votes of the members of this process. Add up those of all shares.
  VoxelVotes votes() const;

private:
  struct Member
  {
    Member(const PointCloud& cloud, const Parameters& parameters);

    SequentialLearner learner;
    StoppingRules rules;
    bool isLearnt = false;
    double progress = 0.;
    TriangleMesh triangles; ///< in the coordinates of the input
    std::vector<std::uint8_t> isPhantom;
    std::vector<std::uint8_t> voxels;
  };

  const PointCloud& cloud_;
  EnsembleParameters parameters_;
  EnsembleShare share_;
  Parameters memberParameters_;
  std::vector<std::unique_ptr<Member>> members_;
  VoxelGrid grid_;
};
}
