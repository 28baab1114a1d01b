// SPDX-License-Identifier: BSD-3-Clause
#include "FirstSurface.h"

#include "BoundaryFilling.h"
#include "DataGaps.h"
#include "DisjointSets.h"
#include "EdgeFlips.h"
#include "MeshBuilder.h"
#include "OccupiedSolid.h"
#include "OneSheet.h"
#include "Simplification.h"
#include "SmallPieces.h"
#include "SurfaceFit.h"
#include "VoxelSurface.h"

#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Tried until what is enclosed becomes less: then gaps between points are wider than what is closed.
constexpr std::array<unsigned, 5> Resolutions{ 16, 24, 32, 48, 64 };
/// Tried where those do not agree.
constexpr unsigned FinestResolution = 80;
constexpr int SmoothingSteps = 4;

constexpr unsigned OpenResolution = 48;
/// Of the skin around an open surface, in voxels.
constexpr double SkinThickness = 1.5;
/// Different ones. With less, a coarse grid tells nothing.
constexpr std::size_t LeastPoints = 500;

/// Of the time that all takes.
constexpr double PartOfGrids = 0.5;

constexpr int FitRounds = 2;
constexpr double FitSmoothness = 1.;
constexpr std::size_t FitSamples = 10; ///< per vertex

struct Candidate
{
  unsigned resolution;
  TriangleMesh surface;
  std::size_t interior;
  std::size_t components;
  long genus;
};

Candidate candidate(const PointCloud& cloud, unsigned resolution)
{
  const OccupiedSolid solid = occupiedSolid(cloud, resolution);
  Candidate result{ resolution, voxelSurface(solid.grid, solid.inside), solid.interiorCount, 0, 0 };
  DisjointSets sets(result.surface.points.size());
  result.components = result.surface.points.size();
  for (const auto& [a, b, c] : result.surface.triangles)
  {
    for (const auto& [from, to] : { std::pair(a, b), std::pair(b, c) })
    {
      if (!sets.areJoined(from, to))
      {
        sets.join(from, to);
        --result.components;
      }
    }
  }
  // A closed surface has three edges for two triangles.
  const long euler = long(result.surface.points.size()) - long(result.surface.triangles.size() / 2);
  result.genus = long(result.components) - euler / 2;
  return result;
}

bool agree(const Candidate& a, const Candidate& b)
{
  return a.genus == b.genus && a.components == b.components;
}

/// Rounds off the steps of voxels.
void smooth(Mesh& mesh)
{
  std::vector<Vector4> positions(mesh.indexEnd());
  for (int step = 0; step < SmoothingSteps; ++step)
  {
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      Vector4 sum;
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        sum += mesh.position(neighbor);
      }
      positions[v] = 0.5f * (mesh.position(v) + 1.f / float(mesh.valence(v)) * sum);
    }
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      mesh.setPosition(v, positions[v]);
    }
  }
}

Mesh meshOf(TriangleMesh surface, const PointCloud& cloud)
{
  for (Eigen::Vector3d& point : surface.points)
  {
    point = cloud.toInput(Vector4(point));
  }
  Mesh mesh = buildMesh(std::move(surface), cloud);
  smooth(mesh);
  return mesh;
}

std::optional<FirstSurface> openSurface(const PointCloud& cloud)
{
  const OccupiedSolid solid = occupiedSolid(cloud, OpenResolution);
  TriangleMesh surface = voxelSurface(solid.grid, solid.inside);
  if (surface.triangles.empty())
  {
    return {};
  }
  FirstSurface result{ meshOf(std::move(surface), cloud), OpenResolution };
  result.isOpen = true;
  if (!keepOneSheet(result.mesh, float(SkinThickness * solid.grid.width)))
  {
    return {};
  }
  return result;
}

/// Of the finest grid that encloses something.
std::optional<FirstSurface> closedSurface(const PointCloud& cloud, const Progress& progress)
{
  std::vector<Candidate> candidates;
  for (const unsigned resolution : Resolutions)
  {
    if (!progress(double(resolution) / FinestResolution))
    {
      break;
    }
    Candidate next = candidate(cloud, resolution);
    if (!candidates.empty() && next.interior < candidates.back().interior)
    {
      break;
    }
    candidates.push_back(std::move(next));
  }
  if (candidates.empty() || candidates.back().interior == 0)
  {
    return {};
  }
  bool isCertain = candidates.size() > 1 && agree(candidates.back(), *(candidates.end() - 2));
  if (!isCertain && candidates.size() == Resolutions.size())
  {
    Candidate finest = candidate(cloud, FinestResolution);
    if (finest.interior > candidates.back().interior && agree(finest, candidates.back()))
    {
      candidates.push_back(std::move(finest));
      isCertain = true;
    }
  }
  Candidate& best = candidates.back();
  return FirstSurface{ meshOf(std::move(best.surface), cloud), best.resolution, best.genus,
    best.components, false, isCertain };
}

/// Of points in Morton order, in which equal ones are neighbours.
std::size_t countDifferent(std::span<const Vector4> points)
{
  std::size_t count = points.empty() ? 0 : 1;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    count += squaredNorm(points[i] - points[i - 1]) > 0.f ? 1 : 0;
  }
  return count;
}

void closeBoundaries(Mesh& mesh)
{
  BoundaryManager boundaries(mesh);
  fillBoundaries(mesh, boundaries, std::numeric_limits<double>::max());
}

bool fitToCloud(
  const PointCloud& cloud, Mesh& mesh, Boundaries boundaries, const Progress& progress)
{
  SurfaceFit fit(cloud, mesh, FitSamples * mesh.vertexCount());
  for (int round = 0; round < FitRounds; ++round)
  {
    flipEdges(mesh);
    const Progress ofRound =
      partOf(progress, double(round) / FitRounds, double(round + 1) / FitRounds);
    if (!fit.findPlaces(partOf(ofRound, 0., 0.5)) ||
      !fit.moveVertices(FitSmoothness, partOf(ofRound, 0.5, 1.)))
    {
      return false;
    }
    flipEdges(mesh);
  }
  if (boundaries == Boundaries::Keep && fit.findPlaces(partOf(progress, 1., 1.)))
  {
    mesh.removeTriangles(findDataGaps(cloud, mesh, fit.places(), fit.medianDistance()));
    mesh.removeTriangles(findSmallPieces(mesh));
    mesh.dropErased();
  }
  return true;
}
}

std::optional<FirstSurface> firstSurface(const PointCloud& cloud, std::size_t mostVertices,
  Boundaries boundaries, const Progress& progress)
{
  if (countDifferent(cloud.points()) < LeastPoints)
  {
    return {};
  }
  std::optional<FirstSurface> result = closedSurface(cloud, partOf(progress, 0., PartOfGrids));
  if (!result)
  {
    result = openSurface(cloud);
  }
  if (!result)
  {
    return {};
  }
  simplify(result->mesh, mostVertices);
  if (boundaries == Boundaries::Close)
  {
    closeBoundaries(result->mesh);
  }
  const bool isDone = result->mesh.vertexCount() <= mostVertices &&
    fitToCloud(cloud, result->mesh, boundaries, partOf(progress, PartOfGrids, 1.)) &&
    result->mesh.vertexCount() > 3;
  return isDone ? std::move(result) : std::nullopt;
}
}
