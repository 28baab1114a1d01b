// SPDX-License-Identifier: BSD-3-Clause
#include "fit/Finish.h"

#include "fit/DataGaps.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"

#include <limits>

namespace neuralmesh
{
namespace
{
/// Defects, at most, whose vertices are taken away if nothing else helps.
constexpr std::size_t MostCollapsed = 200;

VertexIndex nearestToCollapseInto(const Mesh& mesh, VertexIndex v)
{
  VertexIndex nearest = NoVertex;
  float shortest = std::numeric_limits<float>::max();
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    const float squared = squaredNorm(mesh.position(neighbor) - mesh.position(v));
    if (squared < shortest && mesh.canCollapse(v, neighbor))
    {
      shortest = squared;
      nearest = neighbor;
    }
  }
  return nearest;
}
}

Finish::Finish(
  const PointCloud& cloud, Mesh& mesh, const FinishPlan& plan, const Executor& executor)
  : cloud_(cloud)
  , mesh_(mesh)
  , plan_(plan)
  , executor_(executor)
{
}

bool Finish::run(const Progress& progress)
{
  const auto samples = std::size_t(plan_.samplesPerVertex * double(plan_.vertexCount));
  std::optional<SurfaceFit> surfaceFit;
  const auto beginAnew = [&] { surfaceFit.emplace(cloud_, mesh_, samples, executor_); };
  beginAnew();
  double smoothness = plan_.smoothness;
  for (int round = 0; round < plan_.rounds; ++round)
  {
    const double rounds = plan_.rounds;
    const bool isLast = round + 1 == plan_.rounds;
    if (isLast && mesh_.vertexCount() < plan_.vertexCount)
    {
      const double at = round / rounds;
      if (!refine(mesh_, plan_.vertexCount, partOf(progress, at, at)))
      {
        return false;
      }
      flipEdges(mesh_);
      beginAnew();
    }
    if (!fit(*surfaceFit, smoothness, partOf(progress, round / rounds, (round + 1) / rounds)))
    {
      return false;
    }
    if (round == 0)
    {
      smoothness = report_.smoothness;
      if (plan_.bridgeWidth && openGaps(*surfaceFit))
      {
        beginAnew();
      }
      // A fitted surface is smoother than the learnt one, and lets more edges be flipped.
      flipEdges(mesh_);
    }
  }
  repair(partOf(progress, 1., 1.));
  return true;
}

void Finish::repair(const Progress& progress)
{
  IntersectionRepair repair = repairIntersections(mesh_, progress);
  report_.repaired = repair.before;
  report_.left = repair.after;
  while (report_.left.total() > 0 && report_.left.total() <= MostCollapsed)
  {
    const Mesh before = mesh_;
    collapseDefects();
    repair = repairIntersections(mesh_, progress);
    if (repair.after.total() >= report_.left.total() || mesh_.vertexCount() != before.vertexCount())
    {
      mesh_ = before;
      break;
    }
    report_.left = repair.after;
  }
}

/// What cannot be mended is taken away: each vertex of a defect goes into its nearest neighbour. As
/// many come in again where edges are long.
void Finish::collapseDefects()
{
  std::vector<VertexIndex> broken;
  for (const Triangle& triangle : intersectingTriangles(mesh_))
  {
    broken.insert(broken.end(), triangle.begin(), triangle.end());
  }
  for (const Edge& edge : foldedEdges(mesh_))
  {
    const Edge opposite = oppositeTo(mesh_, edge);
    broken.insert(broken.end(), edge.begin(), edge.end());
    broken.insert(broken.end(), opposite.begin(), opposite.end());
  }
  const std::size_t count = mesh_.vertexCount();
  for (const VertexIndex v : broken)
  {
    if (mesh_.isAlive(v))
    {
      const VertexIndex kept = nearestToCollapseInto(mesh_, v);
      if (kept != NoVertex)
      {
        mesh_.collapse(v, kept);
      }
    }
  }
  mesh_.dropErased();
  refine(mesh_, count, [](double) { return true; });
}

bool Finish::fit(SurfaceFit& surfaceFit, double smoothness, const Progress& progress)
{
  if (!surfaceFit.findPlaces(partOf(progress, 0., 0.5)) ||
    !surfaceFit.moveVertices(smoothness, partOf(progress, 0.5, 1.)))
  {
    return false;
  }
  report_.noise = surfaceFit.noise();
  report_.smoothness = surfaceFit.smoothness();
  report_.outlierShare = surfaceFit.outlierShare();
  return true;
}

bool Finish::openGaps(const SurfaceFit& surfaceFit)
{
  const std::size_t count = mesh_.vertexCount();
  const OpenedGaps gaps = openDataGaps(
    cloud_, mesh_, surfaceFit.places(), surfaceFit.medianDistance(), *plan_.bridgeWidth);
  if (!gaps.any())
  {
    return false;
  }
  report_.gapTriangles = gaps.triangles;
  mesh_.dropErased();
  refine(mesh_, count, [](double) { return true; });
  return true;
}
}
