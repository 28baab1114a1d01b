// SPDX-License-Identifier: BSD-3-Clause
#include "run/Remeshing.h"

#include "cloud/MeshBuilder.h"
#include "fit/Finish.h"
#include "fit/MeshQuality.h"
#include "mesh/Pieces.h"
#include "mesh/StoredMesh.h"
#include "mesh/Subdivision.h"
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
  const bool hasRules = parameters.timeLimit > 0. || parameters.maximumIterations > 0 ||
    parameters.targetSampleDistance > 0. || parameters.targetCloudDistance > 0. ||
    parameters.targetNormalChange > 0.;
  for (const auto& [isThere, name] : { std::pair(beside.points, "points in a file"),
         std::pair(beside.firstMesh, "a first mesh or an ensemble"),
         std::pair(beside.weights, "weights"),
         std::pair(beside.sides,
           "what tells the outer side (viewpoints, views, named normals, an up direction)"),
         std::pair(beside.size, "a number of vertices that is to be found"),
         std::pair(beside.levels, "levels"), std::pair(beside.checkpoint, "a checkpoint"),
         std::pair(beside.snapshots, "growth as time"),
         std::pair(beside.automatic, "the automatic choice of parameters"),
         std::pair(beside.explanation, "explained points"),
         std::pair(beside.estimate, "an estimate of the run (--dry-run)"),
         std::pair(hasRules, "a rule that ends a run early"),
         std::pair(parameters.start == Start::Tetrahedron, "another start"),
         std::pair(parameters.topologyLearning, "topology learning"),
         std::pair(parameters.boundaries == Boundaries::Close, "boundaries that are closed"),
         std::pair(parameters.closeHolesBelow > 0., "holes that are closed"),
         std::pair(parameters.computeFeatureStrength, "feature strength"),
         std::pair(parameters.computeUncertainty, "error bars") })
  {
    if (isThere)
    {
      return std::string("A surface is remeshed, not learnt: it and ") + name +
        " exclude each other.";
    }
  }
  return {};
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
  const NearestTriangle nearest(trianglesIn(surface), executor);
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
  result.mesh = trianglesOf(surface, samples);
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
