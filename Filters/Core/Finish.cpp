// SPDX-License-Identifier: BSD-3-Clause
#include "Finish.h"

#include "DataGaps.h"
#include "EdgeFlips.h"
#include "Refinement.h"
#include "SelfIntersections.h"

#include <limits>
#include <numeric>

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

Finish::Finish(const PointCloud& cloud, Mesh& mesh, const Parameters& parameters,
  std::optional<double> bridgeWidth, std::size_t vertexCount, const Executor& executor)
  : cloud_(cloud)
  , mesh_(mesh)
  , parameters_(parameters)
  , bridgeWidth_(bridgeWidth)
  , vertexCount_(vertexCount)
  , executor_(executor)
  , origins_(mesh.vertexCount())
{
  std::iota(this->origins_.begin(), this->origins_.end(), VertexIndex(0));
}

bool Finish::run(const Progress& progress)
{
  const auto samples = std::size_t(this->parameters_.fitSamples * double(this->vertexCount_));
  std::optional<SurfaceFit> surfaceFit;
  const auto beginAnew = [&]
  { surfaceFit.emplace(this->cloud_, this->mesh_, samples, this->executor_); };
  beginAnew();
  double smoothness = this->parameters_.fitSmoothness;
  for (int round = 0; round < this->parameters_.fitRounds; ++round)
  {
    const double rounds = this->parameters_.fitRounds;
    const bool isLast = round + 1 == this->parameters_.fitRounds;
    if (isLast && this->mesh_.vertexCount() < this->vertexCount_)
    {
      const double at = round / rounds;
      if (!this->refineTo(this->vertexCount_, partOf(progress, at, at)))
      {
        return false;
      }
      flipEdges(this->mesh_);
      beginAnew();
    }
    if (!this->fit(*surfaceFit, smoothness, partOf(progress, round / rounds, (round + 1) / rounds)))
    {
      return false;
    }
    if (round == 0)
    {
      smoothness = this->report_.smoothness;
      if (this->bridgeWidth_ && this->openGaps(*surfaceFit))
      {
        beginAnew();
      }
      // A fitted surface is smoother than the learnt one, and lets more edges be flipped.
      flipEdges(this->mesh_);
    }
  }
  this->repair(partOf(progress, 1., 1.));
  return true;
}

void Finish::repair(const Progress& progress)
{
  IntersectionRepair repair = repairIntersections(this->mesh_, progress);
  this->report_.repaired = repair.before;
  this->report_.left = repair.after;
  while (this->report_.left.total() > 0 && this->report_.left.total() <= MostCollapsed)
  {
    const Mesh before = this->mesh_;
    const std::vector<VertexIndex> originsBefore = this->origins_;
    this->collapseDefects();
    repair = repairIntersections(this->mesh_, progress);
    if (repair.after.total() >= this->report_.left.total() ||
      this->mesh_.vertexCount() != before.vertexCount())
    {
      this->mesh_ = before;
      this->origins_ = originsBefore;
      break;
    }
    this->report_.left = repair.after;
  }
}

/// What cannot be mended is taken away: each vertex of a defect goes into its nearest neighbour. As
/// many come in again where edges are long.
void Finish::collapseDefects()
{
  std::vector<VertexIndex> broken;
  for (const Triangle& triangle : intersectingTriangles(this->mesh_))
  {
    broken.insert(broken.end(), triangle.begin(), triangle.end());
  }
  for (const Edge& edge : foldedEdges(this->mesh_))
  {
    const Edge opposite = oppositeTo(this->mesh_, edge);
    broken.insert(broken.end(), edge.begin(), edge.end());
    broken.insert(broken.end(), opposite.begin(), opposite.end());
  }
  const std::size_t count = this->mesh_.vertexCount();
  for (const VertexIndex v : broken)
  {
    if (this->mesh_.isAlive(v))
    {
      const VertexIndex kept = nearestToCollapseInto(this->mesh_, v);
      if (kept != NoVertex)
      {
        this->mesh_.collapse(v, kept);
      }
    }
  }
  this->dropErased();
  this->refineTo(count, [](double) { return true; });
}

bool Finish::fit(SurfaceFit& surfaceFit, double smoothness, const Progress& progress)
{
  if (!surfaceFit.findPlaces(partOf(progress, 0., 0.5)) ||
    !surfaceFit.moveVertices(smoothness, partOf(progress, 0.5, 1.)))
  {
    return false;
  }
  this->report_.noise = surfaceFit.noise();
  this->report_.smoothness = surfaceFit.smoothness();
  this->report_.outlierShare = surfaceFit.outlierShare();
  return true;
}

bool Finish::openGaps(const SurfaceFit& surfaceFit)
{
  const OpenedGaps gaps = openDataGaps(this->cloud_, this->mesh_, surfaceFit.places(),
    surfaceFit.medianDistance(), *this->bridgeWidth_);
  if (!gaps.any())
  {
    return false;
  }
  this->report_.gapTriangles = gaps.triangles;
  // With a single round the mesh is refined by now, and has more vertices than were learnt.
  const std::size_t count = this->origins_.size();
  this->dropErased();
  this->refineTo(count, [](double) { return true; });
  return true;
}

void Finish::dropErased()
{
  std::vector<VertexIndex> origins;
  for (const VertexIndex v : this->mesh_.dropErased())
  {
    origins.push_back(this->origins_[v]);
  }
  this->origins_ = std::move(origins);
}

bool Finish::refineTo(std::size_t count, const Progress& progress)
{
  bool isEnded = false;
  const auto origins =
    refine(this->mesh_, count, [&](double fraction) { return !(isEnded = !progress(fraction)); });
  for (const VertexIndex origin : origins)
  {
    this->origins_.push_back(this->origins_[origin]);
  }
  return !isEnded;
}
}
