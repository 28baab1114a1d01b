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
/// Which members are learnt here, if processes share the work: every `count`-th one from `index` on.
struct EnsembleShare
{
  std::size_t index = 0;
  std::size_t count = 1;
};

/// The first two steps of Algorithm 5 (chapter 10): several meshes of one cloud, which differ by
/// their seeds, and what most of them hold. Members grow by the noise-filtering variant with exact
/// counters and the product's defaults, as spheres.
///
/// What concerns one member may be called at the same time for different ones; what comes out does
/// not depend on that, nor on how members are shared. Members are numbered among those learnt here.
class Ensemble
{
public:
  /// Members of a cloud of few points have fewer vertices: a triangle for every so many points.
  Ensemble(const PointCloud& cloud, const EnsembleParameters& parameters, EnsembleShare share = {});

  /// Voxels of the grid along each axis.
  static std::size_t gridCount(unsigned resolution);

  /// Members that are learnt here.
  std::size_t size() const { return members_.size(); }

  /// Learns on, for some milliseconds.
  void learn(std::size_t member);
  /// Whether all members are learnt, or have stalled.
  bool isLearnt() const;
  /// How much of that is done, 0 to 1.
  double progress() const;
  /// A member as it is now, in the coordinates of the cloud.
  const Mesh& mesh(std::size_t member) const { return members_[member]->learner.mesh(); }
  /// The same without gaps in its numbers, for a learner to start from.
  const Mesh& renumberedMesh(std::size_t member);
  /// Samples that the members here will have drawn in the end, all together, about.
  double expectedSamples() const;

  /// When all members are learnt: looks for the phantoms of each,
  void findPhantoms(std::size_t member);
  /// then tells their boxes: for each member of all shares the least and the most x, y and z, in the
  /// coordinates of the input, or 0 if it is learnt elsewhere,
  std::vector<double> boxes() const;
  /// then, from the sum of all shares, makes the grid in which they are compared: a cube around what
  /// most of them can hold,
  void makeGrid(const std::vector<double>& boxes);
  /// then finds the voxels of each.
  void voxelize(std::size_t member);
  /// Of the members here; those of all shares are to be added up.
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
