// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "fit/IntersectionRepair.h"
#include "fit/SurfaceFit.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace neuralmesh
{
/// What is known of a mesh once it is finished.
struct FinishReport
{
  double noise = 0.;            ///< of the cloud, see SurfaceFit::noise(), in units of the cloud
  double smoothness = 0.;       ///< lambda of the fit
  double outlierShare = 0.;     ///< of the samples
  std::size_t gapTriangles = 0; ///< taken away where there is no data
  DefectCount repaired;         ///< intersections and folds that were there ...
  DefectCount left;             ///< ... and those that could not be mended
};

/// What is done with a mesh once it is learnt: it is fitted to the cloud, opened where the scan has
/// no data if there is a `bridgeWidth`, as openDataGaps() takes it, and made more regular. In the end
/// it has `vertexCount` vertices: if that is more than were learnt, long edges are halved. No vertex
/// may be erased, and none is in the end.
class Finish
{
public:
  Finish(const PointCloud& cloud, Mesh& mesh, const Parameters& parameters,
    std::optional<double> bridgeWidth, std::size_t vertexCount,
    const Executor& executor = Executor::sequential());

  /// Returns false if it was ended before its end; then the mesh is valid all the same.
  bool run(const Progress& progress);

  const FinishReport& report() const { return report_; }
  /// For each vertex, the index of the vertex of the learnt mesh that it is or was split from.
  const std::vector<VertexIndex>& origins() const { return origins_; }

private:
  bool fit(SurfaceFit& surfaceFit, double smoothness, const Progress& progress);
  bool openGaps(const SurfaceFit& surfaceFit);
  void repair(const Progress& progress);
  void collapseDefects();
  /// Closes the gaps in the numbers of the vertices, and in the origins with them.
  void dropErased();
  bool refineTo(std::size_t count, const Progress& progress);

  const PointCloud& cloud_;
  Mesh& mesh_;
  const Parameters& parameters_;
  std::optional<double> bridgeWidth_;
  std::size_t vertexCount_;
  const Executor& executor_;
  std::vector<VertexIndex> origins_;
  FinishReport report_;
};
}
