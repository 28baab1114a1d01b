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
/// A mesh of a patch, and how it was finished.
struct PatchMesh
{
  Mesh mesh;
  FinishReport report;
};

/// A ball of the cloud that holds so many of its points as some of the vertices have to themselves,
/// so that points and noise are to a triangle what they are in a mesh of the whole cloud. A fifth of
/// the points is held out.
///
/// How far these lie from a mesh is measured along a direction that is the same for all meshes: to
/// the closest place they all come, and a rough surface has one close to any point.
class TuningPatch
{
public:
  /// Of the mesh of a patch.
  static constexpr std::uint64_t PatchVertices = 2000;

  TuningPatch(const PointCloud& cloud, Vector4 center, float radius, std::uint64_t vertices);

  /// Patches of the cloud around random points, but for stray ones; all of the cloud, once, if not
  /// much more than a patch is wanted of it. None where there are too few different points.
  static std::vector<TuningPatch> patchesOf(const PointCloud& cloud, const Parameters& parameters);

  /// What is there to learn from.
  const PointCloud& cloud() const { return cloud_; }
  /// How many of the mesh it has to itself.
  std::uint64_t vertices() const { return vertices_; }

  /// Learns a mesh of the patch, all but the last stages of a run. The first surface stays from one
  /// call to the next.
  void learn(const Parameters& parameters, const Progress& progress);
  /// Finishes what was learnt, which stays as it is for other parameters of the fit. Nothing if
  /// there is nothing that was learnt, or if it was ended before.
  std::optional<PatchMesh> finish(const Parameters& parameters, const Progress& progress) const;

  /// Lays down the directions, by the shape at large of a mesh of this patch.
  void aim(const Mesh& mesh);
  std::size_t probeCount() const { return probes_.size(); }
  /// Squared distances of the held-out points from another mesh, or from that one; infinite where
  /// that has its boundary.
  std::vector<double> squaredDistances(const Mesh& mesh) const;

private:
  /// A held-out point, and where to look for meshes from there.
  struct Probe
  {
    Vector4 point;
    Vector4 direction;
    Vector4 foot;         ///< a place on the first mesh
    float farthest = 0.f; ///< no distance counts as more
  };

  /// That without clusters of outliers, from where they were looked for.
  const PointCloud& learntCloud() const { return cleaned_ ? *cleaned_ : cloud_; }
  /// `parameters` for a mesh of the patch.
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
