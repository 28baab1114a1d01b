// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/DataGaps.h"
#include "fit/FidelityRounds.h"
#include "fit/FitGuard.h"
#include "fit/IntersectionRepair.h"
#include "fit/SurfaceFit.h"
#include "mesh/Mesh.h"
#include "mesh/NearestTriangle.h"
#include "mesh/StoredMesh.h"

#include <cstddef>
#include <limits>
#include <optional>

namespace neuralmesh
{
/// What is known of a mesh once it is finished.
struct FinishReport
{
  double noise = 0.;       ///< of the cloud, see SurfaceFit::noise(), in units of the cloud
  double ownNoise = 0.;    ///< what points have of it for themselves, see SharedNoise.h; 0 if clean
  double sharedNoise = 0.; ///< ... and what those of a view share
  double smoothness = 0.;  ///< lambda of the fit
  /// ... at each vertex, in the last round, 0 if there was none; nothing unless it was asked for
  std::optional<VertexProperty<float>> smoothnessOfVertices;
  bool isClean = false;         ///< whether it is that of a cloud without noise to speak of
  double outlierShare = 0.;     ///< of the samples
  std::size_t gapTriangles = 0; ///< taken away where there is no data
  DefectCount repaired;         ///< intersections and folds that were there ...
  DefectCount left;             ///< ... and those that could not be mended
  /// Rounds of the fit that were taken back, as with them the mesh had a worse residual or coverage
  /// than at first, or more intersections; see FitGuard.h.
  int roundsTakenBack = 0;
  int fidelityRounds = 0; ///< rounds that came after those of the plan
  std::size_t heldVertices =
    0; ///< that rounds have left where they were, so that no samples were lost
  double shareBetweenLayers = 0.; ///< see SurfaceFit::shareBetweenLayers(), after the last round
};

/// What is to be done with a mesh once it is learnt.
struct FinishPlan
{
  int rounds = 2;                        ///< of the least-squares fit
  Fidelity fidelity = Fidelity::Default; ///< tells how many come after them, and of which kind
  int mostFidelityRounds = std::numeric_limits<int>::max(); ///< ... but no more than these
  /// What the residual is measured to that may not grow. Where a mesh is to be simplified, what lies ill on
  /// thin parts counts.
  DistanceTo residualTo = DistanceTo::Surface;
  /// Of which the points are, in their coordinates: then none is an outlier, and boundaries are where they are. Null: of
  /// none that is known.
  const NearestTriangle* surface = nullptr;
  bool keepsPlaces = false;     ///< vertices do not go elsewhere: what is known of them is of there
  double smoothness = 0.;       ///< lambda of the fit; 0 = by the noise and the shape
  bool searchesNear = false;    ///< for that lambda, see SurfaceFit::searchNear()
  bool tellsSmoothness = false; ///< of each vertex
  double samplesPerVertex = 10.; ///< in the fit
  std::optional<GapPlan> gaps;   ///< nothing: none is opened or closed
  double closedOutline =
    0.; ///< holes with shorter ones are filled, in units of the cloud; 0 = none
  std::size_t vertexCount = 0; ///< of the finished mesh
};

/// Finishes a mesh that is learnt: fits it to the cloud, opens it where the scan has no data, fills
/// holes that are small enough, and makes it more regular. In the end it has as many vertices as planned: if
/// that is more than were learnt, long edges are halved. No vertex may be erased, and none is in the end;
/// properties follow.
class Finish
{
public:
  /// `normalOf` gives the normal that came with a point of the cloud, if there are some, `viewOf` its view.
  Finish(const PointCloud& cloud, Mesh& mesh, const FinishPlan& plan,
    const Executor& executor = Executor::sequential(), PointNormals normalOf = {},
    PointViews viewOf = {});

  /// Returns false if it was ended before its end; then the mesh is valid all the same. It is as it was at first if the
  /// executor was interrupted.
  bool run(const Progress& progress);

  const FinishReport& report() const { return report_; }

private:
  bool runAll(const StoredMesh& before, const Progress& progress);
  bool runRounds(int rounds, FitGuard& guard, const Progress& progress);
  bool isWorseThan(const StoredMesh& before, FitGuard& guard) const;
  bool isMuchFolded() const;
  bool move(SurfaceFit& surfaceFit, double smoothness, const Progress& progress);
  void tell(const NoiseParts& parts);
  bool openGaps(const SurfaceFit& surfaceFit, bool mustBeFar);
  bool trimOutlines(const SurfaceFit& surfaceFit);
  bool improve(SurfaceFit& surfaceFit, const Progress& progress);
  bool closeHoles();
  bool cutJoints(const SurfaceFit& surfaceFit);
  void dropOddPieces();
  bool repair(SurfaceFit& surfaceFit, FitGuard& guard, const Progress& progress);
  /// How a defect is taken away, beyond what the guard allows anyway.
  enum class MayLose
  {
    SomePoints,
    NoPoints ///< not even of those closer together than their noise
  };
  template <typename Remove>
  bool mendsBy(const Remove& remove, MayLose mayLose, FitGuard& guard, const Progress& progress);
  void collapseDefects();
  bool mendWithoutSlivers(FitGuard& guard, const Progress& progress);

  const PointCloud& cloud_;
  Mesh& mesh_;
  FinishPlan plan_;
  const Executor& executor_;
  PointNormals normalOf_;
  PointViews viewOf_;
  FinishReport report_;
  bool staysUnbroken_ = false; ///< no round may break triangles
  bool isUnbroken_ = false;    ///< none are broken, as the last round has seen
};
}
