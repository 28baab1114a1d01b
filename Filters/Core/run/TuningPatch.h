// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/Finish.h"
#include "learn/Learner.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"
#include "run/Stages.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// A finished mesh of a patch.
struct PatchMesh
{
  Mesh mesh;
  FinishReport report;
};

/// A ball of the cloud with as many points as belong to some of the vertices. So points and noise
/// have the same size compared to triangles as in a mesh of the whole cloud. A fifth of the points
/// is held out.
///
/// The distance of held-out points to a mesh is measured along a direction that is the same for all
/// meshes. The closest place would favour rough surfaces: these have a close place for any point.
class TuningPatch
{
public:
  /// The number of vertices of the mesh of a patch.
  static constexpr std::uint64_t PatchVertices = 2000;

  TuningPatch(const PointCloud& cloud, Vector4 center, float radius, std::uint64_t vertices);

  /// Patches around random points of the cloud, except stray ones. The whole cloud is the only
  /// patch if it is not much larger than a patch. None if there are too few different points.
  static std::vector<TuningPatch> patchesOf(const PointCloud& cloud, const Parameters& parameters);

  /// The points from which the patch learns.
  const PointCloud& cloud() const { return cloud_; }
  /// The number of vertices of the whole mesh that belong to the patch.
  std::uint64_t vertices() const { return vertices_; }

  /// Learns a mesh of the patch: all stages of a run except the last ones. The first surface is
  /// kept for the next call.
  void learn(const Parameters& parameters, const Progress& progress);
  /// Finishes a copy of the learnt mesh, which may be finished again with other parameters of the
  /// fit. Returns nothing if nothing is learnt, or `progress` ended it.
  std::optional<PatchMesh> finish(const Parameters& parameters, const Progress& progress) const;

  /// Sets the directions by the large shape of a mesh of this patch.
  void aim(const Mesh& mesh);
  std::size_t probeCount() const { return probes_.size(); }
  /// The squared distances of the held-out points to that mesh or another one; infinite beyond its
  /// boundary.
  std::vector<double> squaredDistances(const Mesh& mesh) const;

private:
  /// A held-out point, and the line along which its distance is measured.
  struct Probe
  {
    Vector4 point;
    Vector4 direction;
    Vector4 foot;         ///< a place on the first mesh
    float farthest = 0.f; ///< no distance counts as more
  };

  /// The cloud without clusters of outliers, if it was searched for them.
  const PointCloud& learntCloud() const { return cleaned_ ? *cleaned_ : cloud_; }
  /// The parameters for a mesh of the patch.
  Parameters own(Parameters parameters) const;
  void beginFor(const Parameters& parameters, const Progress& progress);

  PointCloud cloud_;
  std::optional<PointCloud> cleaned_;
  std::optional<Beginning> beginning_;
  double densityOfBeginning_ = 0.;
  std::optional<LearntMesh> learnt_;
  bool hasAllVertices_ = false; ///< what was learnt
  Vector4 center_;
  float radius_;
  std::uint64_t vertices_;
  std::vector<Vector4> heldOut_;
  std::vector<Probe> probes_;
};
}
