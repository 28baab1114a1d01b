// SPDX-License-Identifier: BSD-3-Clause
#include "Measures.h"

#include "Report.h"

#include "base/ThreadPool.h"
#include "mesh/SurfaceReport.h"
#include "run/ExplanationByMesh.h"
#include "run/RunEstimate.h"
#include "run/SurfaceComparison.h"

#include <optional>
#include <stdexcept>
#include <vector>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
nb::dict figuresOf(const DistanceFigures& figures)
{
  nb::dict result;
  result["Mean"] = figures.mean;
  result["RMS"] = figures.rootMeanSquare;
  result["Percentile99"] = figures.percentile99;
  result["Maximum"] = figures.maximum;
  result["NormalAngle"] = figures.normalAngle;
  result["NormalConsistency"] = figures.normalConsistency;
  result["EdgeMean"] = figures.edgeMean;
  result["EdgeToSurface"] = figures.edgeToSurface;
  result["EdgeLength"] = figures.edgeLength;
  return result;
}

PlannedRun plannedRunOf(const nb::dict& plan)
{
  const auto number = [&](const char* name) { return nb::cast<double>(plan[name]); };
  return { .vertices = number("vertices"),
    .points = number("points"),
    .bytesOfPoints = number("bytes_of_points"),
    .samplesForFeatures = number("samples_for_features"),
    .samplesPerAddition = number("samples_per_addition"),
    .mostSamples = number("most_samples"),
    .isEnsemble = nb::cast<bool>(plan["is_ensemble"]) };
}

TrialRun trialOf(const nb::dict& trial)
{
  if (trial.size() == 0)
  {
    return {};
  }
  const auto number = [&](const char* name) { return nb::cast<double>(trial[name]); };
  TrialRun result{ .vertices = number("vertices"),
    .growth = {},
    .cloudTime = number("cloud_time"),
    .startTime = number("start_time"),
    .learningTime = number("learning_time"),
    .finishTime = number("finish_time") };
  const auto growth = nb::cast<ArrayOf<double>>(trial["growth"]);
  for (std::size_t i = 0; i + 2 < growth.size(); i += 3)
  {
    const double* row = growth.data() + i;
    result.growth.push_back({ row[0], row[1], row[2] });
  }
  return result;
}

nb::dict figuresOf(const BothWaysFigures& figures)
{
  nb::dict result;
  result["Chamfer"] = figures.chamfer;
  result["ChamferSquared"] = figures.chamferSquared;
  result["Hausdorff"] = figures.hausdorff;
  result["NormalAngle"] = figures.normalAngle;
  result["NormalConsistency"] = figures.normalConsistency;
  result["Precision0_1"] = figures.atTenthPercent.precision;
  result["Recall0_1"] = figures.atTenthPercent.recall;
  result["FScore0_1"] = figures.atTenthPercent.fScore;
  result["Precision0_5"] = figures.atHalfPercent.precision;
  result["Recall0_5"] = figures.atHalfPercent.recall;
  result["FScore0_5"] = figures.atHalfPercent.fScore;
  result["EdgeChamfer"] = figures.edgeChamfer;
  return result;
}

template <typename Value>
nb::object orNone(const std::optional<Value>& value)
{
  return value ? nb::cast(*value) : nb::none();
}
}

nb::object compare(
  TriangleMesh reference, TriangleMesh result, std::size_t samples, std::uint64_t seed, Call& call)
{
  std::optional<SurfaceComparison> comparison;
  try
  {
    const nb::gil_scoped_release unlocked;
    comparison = compareSurfaces(
      reference, result, ComparisonRules{ samples, seed }, call.part(0., 1.), ThreadPool());
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(error.what());
  }
  if (!comparison)
  {
    return nb::none();
  }
  nb::dict figures;
  figures["reference to result"] = figuresOf(comparison->referenceToResult);
  figures["result to reference"] = figuresOf(comparison->resultToReference);
  figures["both ways"] = figuresOf(comparison->bothWays);
  figures["diagonal"] = comparison->referenceDiagonal;
  figures["reference distances"] = arrayOf(std::move(comparison->referenceDistances));
  figures["result distances"] = arrayOf(std::move(comparison->resultDistances));
  return figures;
}

nb::object explain(
  const std::vector<AnyArray>& points, TriangleMesh mesh, double leastPiece, Call& call)
{
  const PointSpans spans = spansOf(points);
  std::optional<PointCloud> cloud;
  std::optional<Explanation> explanation;
  {
    const nb::gil_scoped_release unlocked;
    const ThreadPool executor;
    cloud.emplace(spans, std::span<const double>(), true, executor);
    if (!cloud->hasExtent())
    {
      throw std::invalid_argument(cloud->whyNoExtent());
    }
    ExplanationRules rules;
    rules.leastPiece = leastPiece;
    try
    {
      explanation = explainByMesh(*cloud, mesh, rules, call.part(0., 1.), executor);
    }
    catch (const std::runtime_error& error)
    {
      throw std::invalid_argument(error.what());
    }
  }
  return explanation ? explainedOf(*explanation, *cloud, spans.size()) : nb::object(nb::none());
}

nb::dict report(TriangleMesh mesh)
{
  std::optional<SurfaceReport> found;
  {
    const nb::gil_scoped_release unlocked;
    found = reportSurface(mesh);
  }
  const SurfaceReport& surface = *found;
  nb::dict valences;
  for (const auto& [valence, vertices] : surface.valences)
  {
    valences[nb::cast(valence)] = vertices;
  }
  nb::dict result;
  result["vertices"] = surface.vertices;
  result["triangles"] = surface.triangles;
  result["regular_ratio"] = surface.regularRatio;
  result["valences"] = valences;
  result["triangle_quality"] = surface.meanQuality;
  result["closed"] = surface.isClosed();
  result["edge_manifold"] = surface.isEdgeManifold();
  result["vertex_manifold"] = surface.isVertexManifold();
  result["oriented"] = surface.isOriented();
  result["components"] = surface.components;
  result["genus"] = orNone(surface.genus);
  result["boundary_loops"] = surface.boundaryLoops;
  result["boundary_edges"] = surface.boundaryEdges;
  result["folded_edges"] = surface.foldedEdges;
  result["non_manifold_edges"] = surface.nonManifoldEdges;
  result["non_manifold_vertices"] = surface.nonManifoldVertices;
  result["inconsistent_edges"] = surface.inconsistentEdges;
  result["surface_area"] = surface.area;
  result["volume"] = orNone(surface.volume);
  result["bounding_box_diagonal"] = surface.diagonal;
  result["degenerate_triangles"] = surface.degenerateTriangles;
  result["unused_points"] = surface.unusedPoints;
  result["non_finite_points"] = surface.nonFinitePoints;
  return result;
}

std::string estimate(
  const nb::dict& plan, const nb::dict& trial, const nb::dict& start, double wallSeconds)
{
  return estimateRun(plannedRunOf(plan), trialOf(trial), trialOf(start)).report(wallSeconds);
}

double learntVertices(const nb::dict& plan)
{
  return neuralmesh::learntVertices(plannedRunOf(plan));
}
}
