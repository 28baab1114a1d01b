// SPDX-License-Identifier: BSD-3-Clause
#include "run/Remeshing.h"

#include "cloud/MeshBuilder.h"
#include "fit/Finish.h"
#include "fit/MeshQuality.h"
#include "learn/StoppingRules.h"
#include "mesh/Pieces.h"
#include "mesh/StoredMesh.h"
#include "mesh/Subdivision.h"
#include "run/Exclusions.h"
#include "run/Warnings.h"
#include "start/SurfaceStart.h"

#include <algorithm>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of the samples of the fit, against those of a cloud: they are free, and without noise.
constexpr double TimesMoreSamples = 3.;
/// Of the samples, against those of the fit: some are held out of it.
constexpr double TimesDrawn = 1.25;
constexpr double FewestSamplesOfSurface = 20000.;
constexpr double MostSamplesOfSurface = 4e9;
constexpr double PartOfSurfaceStart = 0.4;

/// Sides stay what they were.
OrientationReport sidesOf(Mesh& mesh)
{
  const std::vector<Piece> pieces = findPieces(mesh);
  const std::vector<Side> sides(pieces.size(), Side{ SideEvidence::Normals });
  return turn(mesh, pieces, sides);
}

FinishPlan planFor(const Mesh& mesh, const NearestTriangle& surface, const Parameters& parameters)
{
  return { .rounds = parameters.fitRounds,
    .fidelity = parameters.fidelity,
    .residualTo = DistanceTo::NearestTriangle,
    .surface = &surface,
    .smoothness = parameters.fitSmoothness,
    .samplesPerVertex = TimesMoreSamples * parameters.fitSamples,
    .gaps = {},
    .vertexCount = mesh.vertexCount() };
}
}

std::string whyNoRemeshing(const Parameters& parameters, const BesideSurface& beside)
{
  return whyExcluded("A surface is remeshed, not learnt: it",
    { { beside.points, "points in a file" }, { beside.firstMesh, "a first mesh or an ensemble" },
      { beside.weights, "weights" },
      { beside.sides, "the outer side (viewpoints, views, named normals, an up direction)" },
      { beside.size, "a number of vertices that is to be found" }, { beside.levels, "levels" },
      { beside.checkpoint, "a checkpoint" }, { beside.snapshots, "growth as time" },
      { beside.automatic, "the automatic choice of parameters" },
      { beside.explanation, "explained points" },
      { beside.estimate, "an estimate of the run (--dry-run)" },
      { mayEndBeforeVertices(parameters), "a rule that ends a run early" },
      { parameters.start == Start::Tetrahedron,
        "learning from a tetrahedron (Start, which the preset Thesis sets)" },
      { parameters.topologyLearning, "topology learning" },
      { parameters.boundaries == Boundaries::Close, "boundaries that are closed" },
      { parameters.closeHolesBelow > 0., "holes that are closed" },
      { parameters.computeFeatureStrength, "feature strength" },
      { parameters.computeUncertainty, "error bars" } });
}

std::size_t samplesOfSurface(const Parameters& parameters)
{
  const double fitted =
    TimesMoreSamples * parameters.fitSamples * double(parameters.numberOfVertices);
  return std::size_t(std::clamp(TimesDrawn * fitted, FewestSamplesOfSurface, MostSamplesOfSurface));
}

Reconstruction remesh(const PointCloud& samples, const Parameters& parameters, Mesh surface,
  const PointNormals& normalOf, const Progress& progress, const Executor& executor)
{
  Reconstruction result;
  result.times.enter(Phase::Start);
  const NearestTriangle nearest(trianglesIn(surface, executor), executor);
  // All of it alike: sheets whose vertices are all at the boundary, too.
  while (surface.vertexCount() < std::size_t(parameters.numberOfVertices))
  {
    surface = subdivide(surface, executor).mesh;
  }
  bool isCancelled = !startFromSurface(
    surface, std::size_t(parameters.numberOfVertices), partOf(progress, 0., PartOfSurfaceStart));
  result.times.leave();
  result.times.enter(Phase::Finish);
  if (!isCancelled && parameters.fitRounds > 0)
  {
    const StoredMesh before(surface, executor);
    Finish finish(samples, surface, planFor(surface, nearest, parameters), executor, normalOf);
    isCancelled = !finish.run(partOf(progress, PartOfSurfaceStart, 1.));
    // Where a piece is small, the fit may lose it.
    if (pieceCount(surface) < pieceCount(before.mesh(executor)))
    {
      surface = before.mesh(executor);
    }
    else if (!isCancelled)
    {
      result.finish = finish.report();
    }
  }
  result.stopReason = isCancelled ? StopReason::Cancelled : StopReason::Vertices;
  result.orientation = sidesOf(surface);
  result.mesh = trianglesOf(surface, samples, executor.uninterrupted());
  result.normals = pointNormals(result.mesh);
  result.activities.assign(surface.vertexCount(), 0.);
  if (!isCancelled)
  {
    result.quality =
      measureQuality(samples, surface, result.mesh, executor, DistanceTo::NearestTriangle);
  }
  result.surface = std::move(surface);
  result.warnings = warningsOfSurface(result, parameters);
  result.times.leave();
  return result;
}
}
