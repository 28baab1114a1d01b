// SPDX-License-Identifier: BSD-3-Clause
#include "start/FirstSurface.h"

#include "base/DisjointSets.h"
#include "cloud/MeshBuilder.h"
#include "fit/DataGaps.h"
#include "fit/SurfaceFit.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Simplification.h"
#include "start/OccupiedSolid.h"
#include "start/OneSheet.h"
#include "start/VoxelSurface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Tried until what is enclosed becomes less: then gaps between points are wider than what is closed.
constexpr std::array<unsigned, 5> Resolutions{ 16, 24, 32, 48, 64 };
/// Tried where those do not agree.
constexpr std::array<unsigned, 2> FinestResolutions{ 80, 96 };
constexpr int SmoothingSteps = 4;
/// Gaps of so many are closed by a grid.
constexpr double ClosedVoxels = 2.;

/// For the skin around an open surface, at least so many in an occupied voxel: with less, it is torn.
constexpr double LeastPointsPerVoxel = 2.;
/// Of a skin, in voxels.
constexpr double SkinThickness = 1.5;
/// Different ones. With less, a coarse grid tells nothing.
constexpr std::size_t LeastPointsForGrid = 500;

/// Of the time that all takes.
constexpr double PartOfGrids = 0.5;

/// Above, points lie in two layers. Noise has 0.8, what is evenly spread between two planes 0.87.
constexpr double EvennessOfLayers = 0.88;

constexpr int FitRounds = 2;
constexpr double FitSmoothness = 1.;
constexpr std::size_t FitSamples = 10; ///< per vertex

struct SurfaceCandidate
{
  unsigned resolution;
  TriangleMesh surface;
  std::size_t interior;
  std::size_t components;
  long genus;
  double bridgeWidth;
};

double bridgeWidthOf(const OccupiedSolid& solid) { return ClosedVoxels * solid.grid.width; }

SurfaceCandidate candidate(const OccupiedSolid& solid, unsigned resolution)
{
  SurfaceCandidate result{ resolution, voxelSurface(solid.grid, solid.inside), solid.interiorCount,
    0, 0, bridgeWidthOf(solid) };
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

bool agree(const SurfaceCandidate& a, const SurfaceCandidate& b)
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

struct Skin
{
  unsigned resolution;
  OccupiedSolid solid;
};

/// A thin closed skin around the points: of the finest grid that the points are dense enough for.
std::optional<FirstSurface> finestSkin(const PointCloud& cloud, std::span<const Skin> skins)
{
  const auto isDense = [&](const Skin& skin) {
    return double(cloud.points().size()) >= LeastPointsPerVoxel * double(skin.solid.occupiedCount);
  };
  const auto finest = std::find_if(skins.rbegin(), skins.rend(), isDense);
  if (finest == skins.rend())
  {
    return {};
  }
  const OccupiedSolid& solid = finest->solid;
  TriangleMesh surface = voxelSurface(solid.grid, solid.inside);
  if (surface.triangles.empty())
  {
    return {};
  }
  FirstSurface result{ meshOf(std::move(surface), cloud), finest->resolution };
  result.bridgeWidth = bridgeWidthOf(solid);
  result.skinThickness = float(SkinThickness * solid.grid.width);
  return result;
}

/// Of the finest grid that encloses something; if there is none, all of them give `skins`.
std::optional<FirstSurface> closedSurface(
  const PointCloud& cloud, std::vector<Skin>& skins, const Progress& progress)
{
  std::vector<SurfaceCandidate> candidates;
  for (const unsigned resolution : Resolutions)
  {
    if (!progress(double(resolution) / FinestResolutions.back()))
    {
      break;
    }
    OccupiedSolid solid = occupiedSolid(cloud, resolution);
    const bool isLeaky = !candidates.empty() && solid.interiorCount < candidates.back().interior;
    if (solid.enclosesSomething() && !isLeaky)
    {
      candidates.push_back(candidate(solid, resolution));
    }
    else if (!candidates.empty())
    {
      break;
    }
    else
    {
      skins.push_back({ resolution, std::move(solid) });
    }
  }
  if (candidates.empty())
  {
    return {};
  }
  for (const unsigned resolution : FinestResolutions)
  {
    const std::size_t count = candidates.size();
    if (candidates.back().resolution < Resolutions.back() ||
      (count > 1 && agree(candidates[count - 1], candidates[count - 2])))
    {
      break;
    }
    SurfaceCandidate next = candidate(occupiedSolid(cloud, resolution), resolution);
    if (next.interior < candidates.back().interior)
    {
      break;
    }
    candidates.push_back(std::move(next));
  }
  // On fine grids outliers can make handles that coarser ones are without.
  const auto confirmed = std::adjacent_find(candidates.rbegin(), candidates.rend(), agree);
  const bool isCertain = confirmed != candidates.rend();
  SurfaceCandidate& best = isCertain ? *confirmed : candidates.back();
  return FirstSurface{ meshOf(std::move(best.surface), cloud), best.resolution, best.genus,
    best.components, false, isCertain, best.bridgeWidth };
}

void closeBoundaries(Mesh& mesh)
{
  BoundaryManager boundaries(mesh);
  fillBoundaries(mesh, boundaries, std::numeric_limits<double>::max());
}

/// Fits a mesh to the cloud and opens it, or closes it. Returns false if it was ended before.
class FirstFit
{
public:
  FirstFit(const PointCloud& cloud, Mesh& mesh, const Executor& executor)
    : cloud_(cloud)
    , mesh_(mesh)
    , fit_(cloud, mesh, FitSamples * mesh.vertexCount(), executor)
  {
  }

  bool run(const Progress& progress)
  {
    for (int round = 0; round < FitRounds; ++round)
    {
      flipEdges(mesh_);
      const Progress ofRound =
        partOf(progress, double(round) / FitRounds, double(round + 1) / FitRounds);
      if (!fit_.findPlaces(partOf(ofRound, 0., 0.5)) ||
        !fit_.moveVertices(FitSmoothness, partOf(ofRound, 0.5, 1.)))
      {
        return false;
      }
      flipEdges(mesh_);
    }
    return fit_.findPlaces(partOf(progress, 1., 1.));
  }

  /// Whether the points lie in two layers, with the mesh between them.
  bool isBetweenLayers() const { return fit_.distanceEvenness() > EvennessOfLayers; }

  void openGaps(double bridgeWidth)
  {
    openDataGaps(cloud_, mesh_, fit_.places(), fit_.medianDistance(), bridgeWidth);
    mesh_.dropErased();
  }

private:
  const PointCloud& cloud_;
  Mesh& mesh_;
  SurfaceFit fit_;
};

/// One sheet of a skin, if there is one and the points lie on it.
std::optional<FirstSurface> openSurface(const PointCloud& cloud, const FirstSurface& skin,
  std::size_t mostVertices, Boundaries boundaries, const Progress& progress,
  const Executor& executor)
{
  FirstSurface result = skin;
  result.isOpen = true;
  if (!keepOneSheet(result.mesh, skin.skinThickness))
  {
    return {};
  }
  simplify(result.mesh, mostVertices);
  FirstFit fit(cloud, result.mesh, executor);
  if (!fit.run(progress) || fit.isBetweenLayers())
  {
    return {};
  }
  if (boundaries == Boundaries::Keep)
  {
    fit.openGaps(result.bridgeWidth);
  }
  else
  {
    closeBoundaries(result.mesh);
  }
  return result;
}
}

std::optional<FirstSurface> firstSurface(const PointCloud& cloud, std::size_t mostVertices,
  Boundaries boundaries, const Progress& progress, const Executor& executor)
{
  if (cloud.differentCount() < LeastPointsForGrid)
  {
    return {};
  }
  const auto hasRightSize = [&](const FirstSurface& surface)
  {
    const std::size_t count = surface.mesh.vertexCount();
    return count > 3 && count <= mostVertices;
  };
  std::vector<Skin> skins;
  std::optional<FirstSurface> result =
    closedSurface(cloud, skins, partOf(progress, 0., PartOfGrids));
  const Progress fitting = partOf(progress, PartOfGrids, 1.);
  const bool hasInterior = result.has_value();
  if (!hasInterior && (result = finestSkin(cloud, skins)))
  {
    auto sheet =
      openSurface(cloud, *result, mostVertices, boundaries, partOf(fitting, 0., 0.5), executor);
    if (sheet && hasRightSize(*sheet))
    {
      return sheet;
    }
  }
  if (!result)
  {
    return {};
  }
  simplify(result->mesh, mostVertices);
  FirstFit fit(cloud, result->mesh, executor);
  if (!hasRightSize(*result) || !fit.run(partOf(fitting, 0.5, 1.)))
  {
    return {};
  }
  // Of a thin solid any gap would show the other side.
  if (hasInterior && boundaries == Boundaries::Keep)
  {
    fit.openGaps(result->bridgeWidth);
  }
  return hasRightSize(*result) ? std::move(result) : std::nullopt;
}
}
