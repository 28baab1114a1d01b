// SPDX-License-Identifier: BSD-3-Clause
#include "start/FirstSurface.h"

#include "base/DisjointSets.h"
#include "cloud/MeshBuilder.h"
#include "fit/DataGaps.h"
#include "fit/SurfaceFit.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/EdgeFlips.h"
#include "mesh/Pieces.h"
#include "mesh/Simplification.h"
#include "mesh/Subdivision.h"
#include "start/BestFront.h"
#include "start/Evidence.h"
#include "start/OccupiedSolid.h"
#include "start/OneSheet.h"
#include "start/SkinLayers.h"
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

/// At least so many in an occupied voxel: with less, surfaces are torn.
constexpr double LeastPointsPerVoxel = 2.;
/// Of a skin, in voxels: of points without noise it is one to two thick.
constexpr double SkinThickness = 1.5;
/// If it is thicker, noise is wider than voxels.
constexpr double MostSkinThickness = 2.;
/// Of the neighbourhoods that tell layers in a skin.
constexpr float RadiusByThickness = 2.f;
/// Different ones. With less, a coarse grid tells nothing.
constexpr std::size_t LeastPointsForGrid = 500;

/// Of the time that all takes.
constexpr double PartOfGrids = 0.5;

/// Above, points lie in two layers. Noise has 0.8, what is evenly spread between two planes 0.87.
constexpr double EvennessOfLayers = 0.88;

/// A closed solid that leaves so many points unexplained is not what they lie on.
constexpr double LeastUnexplained = 0.005;
/// The same of one around gaps, for which a finer grid is leaky: it may have lost what is narrow. So few are
/// found among more points.
constexpr double LeastUnexplainedIfLeaky = 0.001;
constexpr std::size_t AskedIfLeaky = 16000;
/// The same of one sheet, which may have lost what is thin.
constexpr double LeastUnexplainedBySheet = 0.002;
/// Of a sheet, in edges: with more it lies between layers.
constexpr double MostMedianOfSheet = 0.1;
/// Of a closed solid, which may jump from one layer to the other: noise of 0.5 % of the diagonal has 0.14.
constexpr double MostMedianOfSolid = 0.2;
/// A sheet with more boundaries was torn.
constexpr std::size_t MostLoopsOfSheet = 2;
/// A sheet that has more of its vertices at its boundary is a ribbon of a few voxels.
constexpr double MostAtBoundary = 0.5;
/// Of a front that reaches the edges of wedges, so many more vertices may be kept: simplification crosses their sides.
constexpr double MoreOfEdges = 1.2;
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

bool isDenseFor(const OccupiedSolid& solid, const PointCloud& cloud)
{
  return double(cloud.points().size()) >= LeastPointsPerVoxel * double(solid.occupiedCount);
}

struct Skin
{
  unsigned resolution;
  OccupiedSolid solid;
};

/// A closed skin around the points.
std::optional<FirstSurface> skinSurface(const PointCloud& cloud, const Skin& skin)
{
  const double width = skin.solid.grid.width;
  TriangleMesh surface = voxelSurface(skin.solid.grid, skin.solid.inside);
  if (surface.triangles.empty())
  {
    return {};
  }
  FirstSurface result{ meshOf(std::move(surface), cloud), skin.resolution };
  result.bridgeWidth = bridgeWidthOf(skin.solid);
  const auto voxels = double(std::count(skin.solid.inside.begin(), skin.solid.inside.end(), 1));
  // The area is that of two sides.
  const double thickness = 2. * voxels * width * width / areaOf(result.mesh);
  result.skinThickness = float(SkinThickness * width * std::max(1., thickness / MostSkinThickness));
  return result;
}

/// Of points that enclose nothing.
struct SkinSurfaces
{
  std::optional<FirstSurface> finest;  ///< of the finest grid that the points are dense enough for
  std::optional<FirstSurface> ofSheet; ///< of the finest of those whose voxels are wider than noise
};

/// A grid finer than the noise shows both sides of a band of points around a sheet. If all are finer, the
/// coarsest is the closest to one. Where points lie in two layers, coarse grids show one.
SkinSurfaces skinSurfaces(
  const PointCloud& cloud, const NearestPoints& nearest, std::span<const Skin> skins)
{
  SkinSurfaces result;
  bool isThin = false;
  for (auto skin = skins.rbegin(); skin != skins.rend() && !isThin; ++skin)
  {
    auto surface =
      isDenseFor(skin->solid, cloud) ? skinSurface(cloud, *skin) : std::optional<FirstSurface>();
    if (surface)
    {
      const auto thin = float(SkinThickness * skin->solid.grid.width);
      isThin = surface->skinThickness <= thin;
      if (!result.finest)
      {
        result.finest = surface;
        if (!isThin && lieInTwoLayers(nearest, RadiusByThickness * surface->skinThickness))
        {
          surface->skinThickness = thin;
          isThin = true;
        }
      }
      result.ofSheet = std::move(surface);
    }
  }
  return result;
}

/// Of the finest grid that encloses something; if there is none, all of them give `skins`.
std::optional<FirstSurface> closedSurface(const PointCloud& cloud, std::vector<Skin>& skins,
  const Progress& progress, const Executor& executor)
{
  std::vector<SurfaceCandidate> candidates;
  bool isLeaky = false;
  for (const unsigned resolution : Resolutions)
  {
    if (!progress(double(resolution) / FinestResolutions.back()))
    {
      break;
    }
    OccupiedSolid solid = occupiedSolid(cloud, resolution, executor);
    const bool enclosesLess =
      !candidates.empty() && solid.interiorCount < candidates.back().interior;
    if (solid.enclosesSomething() && !enclosesLess)
    {
      candidates.push_back(candidate(solid, resolution));
    }
    else if (!candidates.empty())
    {
      isLeaky = isDenseFor(solid, cloud);
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
    SurfaceCandidate next = candidate(occupiedSolid(cloud, resolution, executor), resolution);
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
    best.components, false, isCertain, best.bridgeWidth, isLeaky };
}

/// Whether the normals of a piece are nearly alike: its area with a direction is nearly its area.
bool isFlat(const Mesh& mesh, const Piece& piece)
{
  constexpr double PartOfFlatSheet = 0.95;
  constexpr double NormalsOfDirectedArea = 6.;
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();
  for (const VertexIndex v : piece.vertices)
  {
    const Vector4 normal = mesh.normal(v);
    normals += Eigen::Vector3d(double(normal[0]), double(normal[1]), double(normal[2]));
  }
  return normals.norm() > PartOfFlatSheet * NormalsOfDirectedArea * piece.area;
}

/// The outlines of almost flat sheets stay: what closes them would lie on the sheet.
void closeBoundaries(Mesh& mesh)
{
  constexpr float CosineOfOutline = -0.95f;
  constexpr double Any = std::numeric_limits<double>::max();
  BoundaryManager boundaries(mesh);
  fillBoundaries(
    mesh, boundaries, Any, nullptr, std::numeric_limits<std::size_t>::max(), CosineOfOutline);
  if (boundaries.loopCount() == 0)
  {
    return;
  }
  std::vector<std::uint8_t> isBent(mesh.indexEnd());
  for (const Piece& piece : findPieces(mesh))
  {
    const std::uint8_t value = isFlat(mesh, piece) ? 0 : 1;
    for (const VertexIndex v : piece.vertices)
    {
      isBent[v] = value;
    }
  }
  for (BoundaryManager::LoopIndex index = 0; index < boundaries.loops().size(); ++index)
  {
    const BoundaryManager::Loop loop = boundaries.loops()[index];
    if (loop.size > 0 && isBent[loop.first] != 0)
    {
      fillBoundary(mesh, boundaries, index, -1.f, Any);
    }
  }
}

/// Fits a mesh to the cloud and opens it, or closes it. Returns false if it was ended before.
class FirstFit
{
public:
  FirstFit(const PointCloud& cloud, Mesh& mesh, const Executor& executor)
    : cloud_(cloud)
    , mesh_(mesh)
    , executor_(executor)
    , fit_(cloud, mesh, FitSamples * mesh.vertexCount(), executor)
  {
  }

  bool run(const Progress& progress)
  {
    for (int round = 0; round < FitRounds; ++round)
    {
      flipEdges(mesh_, EdgesToFlip::All, executor_);
      const Progress ofRound =
        partOf(progress, double(round) / FitRounds, double(round + 1) / FitRounds);
      if (!fit_.findPlaces(partOf(ofRound, 0., 0.5)) ||
        !fit_.moveVertices(FitSmoothness, partOf(ofRound, 0.5, 1.)))
      {
        return false;
      }
      flipEdges(mesh_, EdgesToFlip::All, executor_);
    }
    return fit_.findPlaces(partOf(progress, 1., 1.));
  }

  /// Whether the points lie in two layers, with the mesh between them.
  bool isBetweenLayers() const { return fit_.distanceEvenness() > EvennessOfLayers; }

  void openGaps(double bridgeWidth, double leastPiece)
  {
    openDataGaps(cloud_, mesh_, fit_.places(), fit_.medianDistance(),
      { bridgeWidth, true, leastPiece, { .isFitted = false } }, executor_);
    mesh_.dropErased(executor_);
  }

private:
  const PointCloud& cloud_;
  Mesh& mesh_;
  const Executor& executor_;
  SurfaceFit fit_;
};

/// A first surface, and what the points say of it.
struct Candidate
{
  FirstSurface surface;
  Evidence evidence = {};
  bool explains = false;        ///< the points, so that no other needs to be tried
  bool isBetweenLayers = false; ///< of points, or jumps from one to the other
  bool isOneSheet = false;      ///< near all points, though noise may be as wide as its triangles
  bool isRibbon = false;        ///< a sheet that is hardly wider than voxels
};

double partAtBoundary(const Mesh& mesh)
{
  std::size_t count = 0;
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    count += mesh.isBoundary(v) ? 1 : 0;
  }
  return double(count) / double(mesh.indexEnd());
}

/// In learning, triangles that go from one side of a ribbon to the other fold: it gets vertices within. Returns false
/// if it was ended before.
bool refineRibbon(const PointCloud& cloud, Mesh& mesh, std::size_t mostVertices,
  const Progress& progress, const Executor& executor)
{
  while (partAtBoundary(mesh) > MostAtBoundary && 4 * mesh.vertexCount() <= mostVertices)
  {
    if (!FirstFit(cloud, mesh, executor).run(progress))
    {
      return false;
    }
    mesh = subdivide(mesh, executor).mesh;
  }
  return true;
}

/// One sheet of a skin, if there is one and the points lie on it.
std::optional<Candidate> openSurface(const PointCloud& cloud, const FirstSurface& skin,
  std::size_t mostVertices, Boundaries boundaries, double leastPiece, const Progress& progress,
  const Executor& executor)
{
  Candidate result{ skin };
  FirstSurface& surface = result.surface;
  surface.isOpen = true;
  if (!keepOneSheet(surface.mesh, skin.skinThickness))
  {
    return {};
  }
  result.isRibbon = partAtBoundary(surface.mesh) > MostAtBoundary;
  simplify(surface.mesh, mostVertices);
  if (result.isRibbon &&
    !refineRibbon(cloud, surface.mesh, mostVertices, partOf(progress, 0., 0.), executor))
  {
    return {};
  }
  FirstFit fit(cloud, surface.mesh, executor);
  if (!fit.run(progress) || fit.isBetweenLayers())
  {
    return {};
  }
  if (boundaries == Boundaries::Keep)
  {
    fit.openGaps(surface.bridgeWidth, leastPiece);
  }
  else
  {
    closeBoundaries(surface.mesh);
  }
  return result;
}

bool hasRightSize(const FirstSurface& surface, std::size_t mostVertices)
{
  const std::size_t count = surface.mesh.vertexCount();
  return count > 3 && count <= mostVertices;
}

/// The closed solid, fitted, and opened where there is no data if that is to be. Nothing if it has too
/// many vertices, or the run was ended.
std::optional<Candidate> solidCandidate(const PointCloud& cloud, const NearestPoints& nearest,
  FirstSurface solid, std::size_t mostVertices, Boundaries boundaries, double leastPiece,
  const Progress& progress, const Executor& executor)
{
  simplify(solid.mesh, mostVertices);
  FirstFit fit(cloud, solid.mesh, executor);
  if (!hasRightSize(solid, mostVertices) || !fit.run(progress))
  {
    return {};
  }
  const bool isBetweenLayers = fit.isBetweenLayers();
  if (boundaries == Boundaries::Keep)
  {
    fit.openGaps(solid.bridgeWidth, leastPiece);
  }
  if (!hasRightSize(solid, mostVertices))
  {
    return {};
  }
  const Evidence evidence =
    evidenceFor(cloud, nearest, solid.mesh, solid.isLeaky ? AskedIfLeaky : UsuallyAsked, executor);
  Candidate result{ std::move(solid), evidence };
  result.isBetweenLayers = isBetweenLayers || evidence.medianInEdges >= MostMedianOfSolid;
  result.explains = result.surface.isCertain && !result.isBetweenLayers &&
    evidence.unexplained < (result.surface.isLeaky ? LeastUnexplainedIfLeaky : LeastUnexplained);
  return result;
}

/// One sheet of the skin, if that is one.
std::optional<Candidate> sheetCandidate(const PointCloud& cloud, const NearestPoints& nearest,
  const FirstSurface& skin, std::size_t mostVertices, Boundaries boundaries, double leastPiece,
  const Progress& progress, const Executor& executor)
{
  auto result = openSurface(cloud, skin, mostVertices, boundaries, leastPiece, progress, executor);
  if (!result || !hasRightSize(result->surface, mostVertices))
  {
    return {};
  }
  const Mesh& mesh = result->surface.mesh;
  result->evidence = evidenceFor(cloud, nearest, mesh, UsuallyAsked, executor);
  result->isOneSheet = result->evidence.unexplained < LeastUnexplainedBySheet &&
    pieceCount(mesh) == 1 && BoundaryManager(mesh).loopCount() <= MostLoopsOfSheet;
  // The outline of a ribbon is known better from a front.
  result->explains =
    result->isOneSheet && !result->isRibbon && result->evidence.medianInEdges < MostMedianOfSheet;
  return result;
}

/// The skin as it is: a thin solid, of which any gap would show the other side.
std::optional<FirstSurface> thinSolid(const PointCloud& cloud, FirstSurface skin,
  std::size_t mostVertices, const Progress& progress, const Executor& executor)
{
  simplify(skin.mesh, mostVertices);
  FirstFit fit(cloud, skin.mesh, executor);
  return hasRightSize(skin, mostVertices) && fit.run(progress) ? std::optional(std::move(skin))
                                                               : std::nullopt;
}

/// The best front as a first surface, if there is one.
std::optional<FirstSurface> surfaceOfFront(const PointCloud& cloud, const NearestPoints& nearest,
  std::size_t mostVertices, Boundaries boundaries, const Progress& progress, double leastPiece,
  bool mustBeCertain)
{
  auto best = bestFront(cloud, nearest, mostVertices, progress, leastPiece, mustBeCertain);
  if (!best || !progress(1.))
  {
    return {};
  }
  const auto most = std::size_t((best->reachesEdges ? MoreOfEdges : 1.) * double(mostVertices));
  FirstSurface result;
  result.mesh = std::move(best->mesh);
  result.isOpen = true;
  result.isCertain = isCertain(*best);
  result.bridgeWidth = 2. * result.mesh.meanEdge();
  simplify(result.mesh, most);
  if (boundaries == Boundaries::Close)
  {
    closeBoundaries(result.mesh);
  }
  return hasRightSize(result, most) ? std::optional(std::move(result)) : std::nullopt;
}
}

std::optional<FirstSurface> firstSurface(const PointCloud& cloud, std::size_t mostVertices,
  std::size_t mostOfFront, Boundaries boundaries, const Progress& progress,
  const Executor& executor, double leastPiece)
{
  if (cloud.differentCount() < LeastPointsForGrid)
  {
    return {};
  }
  std::vector<Skin> skins;
  auto solid = closedSurface(cloud, skins, partOf(progress, 0., PartOfGrids), executor);
  const bool isSolid = solid.has_value();
  const NearestPoints nearest(cloud.points(), executor);
  const SkinSurfaces skin = isSolid ? SkinSurfaces() : skinSurfaces(cloud, nearest, skins);
  const Progress ofGrid = partOf(progress, PartOfGrids, 0.5 * (1. + PartOfGrids));
  const Progress ofFront = partOf(progress, 0.5 * (1. + PartOfGrids), 1.);
  std::optional<Candidate> grid;
  if (isSolid)
  {
    grid = solidCandidate(
      cloud, nearest, std::move(*solid), mostVertices, boundaries, leastPiece, ofGrid, executor);
  }
  else if (skin.ofSheet)
  {
    grid = sheetCandidate(
      cloud, nearest, *skin.ofSheet, mostVertices, boundaries, leastPiece, ofGrid, executor);
  }
  if (grid && grid->explains && progress(1.))
  {
    return std::move(grid->surface);
  }
  const bool isClosed = grid && isSolid && grid->surface.isCertain;
  if (auto front =
        surfaceOfFront(cloud, nearest, mostOfFront, boundaries, ofFront, leastPiece, isClosed))
  {
    const double left = grid ? grid->evidence.unexplained : 1.;
    // What the grid gave does not explain the points for another reason, if not for this.
    const double most = front->isCertain ? std::max(left, LeastUnexplainedBySheet) : left;
    // Of a closed solid that explains nearly all points the handles are known. An uncertain front
    // goes from one side of a noisy sheet to the other.
    const bool areHandlesKnown = grid &&
      ((isClosed && !grid->isBetweenLayers && grid->evidence.unexplained < LeastUnexplained) ||
        (grid->isOneSheet && !front->isCertain));
    const bool hasMoreHandles =
      areHandlesKnown && genusOf(front->mesh) > genusOf(grid->surface.mesh);
    if ((front->isCertain || !isClosed) && !hasMoreHandles &&
      evidenceFor(cloud, nearest, front->mesh, UsuallyAsked, executor).unexplained <= most)
    {
      return front;
    }
  }
  if (grid)
  {
    return std::move(grid->surface);
  }
  return skin.finest ? thinSolid(cloud, *skin.finest, mostVertices, ofFront, executor)
                     : std::nullopt;
}

std::optional<FirstSurface> surfaceWithNarrowParts(const PointCloud& cloud, std::size_t mostOfFront,
  Boundaries boundaries, const Progress& progress, const Executor& executor, double leastPiece)
{
  if (cloud.differentCount() < LeastPointsForGrid)
  {
    return {};
  }
  const NearestPoints nearest(cloud.points(), executor);
  auto front = surfaceOfFront(cloud, nearest, mostOfFront, boundaries, progress, leastPiece, true);
  const bool explains = front && front->isCertain &&
    evidenceFor(cloud, nearest, front->mesh, UsuallyAsked, executor).unexplained < LeastUnexplained;
  return explains ? std::move(front) : std::nullopt;
}
}
