// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "base/WarningTopic.h"
#include "cloud/PointsOnLine.h"
#include "mesh/NarrowStrips.h"
#include "mesh/Pieces.h"
#include "run/BareArea.h"
#include "run/PointWarnings.h"
#include "run/WarningTexts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>

namespace neuralmesh
{
namespace
{
/// Of the vertices.
constexpr double MostBetweenLayers = 0.1;
/// Of the area: less is not worth a word.
constexpr double LeastUnknownSide = 0.001;
constexpr double MostTurned = 0.005;
/// Normals of which two of five are turned make up half of it.
constexpr double MostContrary = 0.01;
/// Of the area: bridges over gaps have less.
constexpr double MostBare = 0.04;
/// ... and so has one bridge.
constexpr double LeastGap = 0.0002;
/// Of the triangles.
constexpr double MostSlivers = 0.002;
constexpr double WholeArea = 0.999;
/// Of the vertices.
constexpr double MostDisagreeing = 0.02;
/// On both sides of noise webs: less is chance.
constexpr std::size_t FewestOnWebs = 2;
/// A closed mesh needs at least four vertices.
constexpr std::size_t FewestVertices = 4;

void warnOfBareArea(double share, WarningList& warnings)
{
  if (share > MostBare)
  {
    warnings.add(WarningTopic::SurfaceWithoutPoints,
      percent(share) +
        " of the surface has almost no points: its triangles span gaps or reach out to stray "
        "points. Look at it before you use the mesh: its point data Support is 0. Remove stray "
        "points, and reconstruct distant bodies one by one.");
  }
}

/// A piece is no surface of the cloud if none of its vertices rests on points, however small it is.
void warnOfBarePieces(
  const Mesh& surface, const VertexSupport& support, const PointCloud& cloud, WarningList& warnings)
{
  if (support.weights.size() != surface.vertexCount())
  {
    return;
  }
  const auto isBare = [&](VertexIndex v) { return !(support.weights[v] > 0.); };
  std::size_t count = 0;
  Vector4 place;
  std::vector<bool> isFound(surface.indexEnd(), false);
  std::vector<VertexIndex> bare;
  for (VertexIndex first = 0; first < surface.indexEnd(); ++first)
  {
    if (isFound[first] || !isBare(first) || !surface.isAlive(first))
    {
      continue;
    }
    // The bare ones that hang together with it are a piece if no others do.
    bool isPiece = true;
    isFound[first] = true;
    bare.assign(1, first);
    for (std::size_t i = 0; i < bare.size(); ++i)
    {
      for (const VertexIndex neighbor : surface.ring(bare[i]))
      {
        isPiece = isPiece && isBare(neighbor);
        if (isBare(neighbor) && !isFound[neighbor])
        {
          isFound[neighbor] = true;
          bare.push_back(neighbor);
        }
      }
    }
    if (isPiece)
    {
      place = count == 0 ? surface.position(first) : place;
      ++count;
    }
  }
  if (count > 0)
  {
    warnings.add(WarningTopic::SurfaceWithoutPoints,
      counted(count, "piece", "pieces") + " of the mesh without any points, as around " +
        placeText(cloud.toInput(place), cloud) +
        ": the first surface followed outliers there. Remove the piece, or drop small pieces "
        "(--keep-pieces).");
  }
}

void warnOfGaps(std::vector<SpannedGap> gaps, const PointCloud& cloud, WarningList& warnings)
{
  std::erase_if(gaps, [](const SpannedGap& gap) { return gap.share < LeastGap; });
  if (gaps.empty())
  {
    return;
  }
  std::string where;
  for (std::size_t i = 0; i < std::min(gaps.size(), MostPlacesNamed); ++i)
  {
    where += (i == 0 ? "" : ", ") + percent(gaps[i].share) + " of the surface around " +
      placeText(gaps[i].center, cloud);
  }
  where += otherPlaces(gaps.size(), MostPlacesNamed);
  warnings.add(WarningTopic::GapIsSpanned,
    "The mesh spans gaps of the cloud: " + where +
      ". The surface there is farther from all points than they are from each other: it is a "
      "guess, "
      "or it closes a hole. Scan these places, use more vertices, or remove the triangles there. "
      "If gaps are to be filled, close all boundaries (--boundaries close).");
}

/// The reason why triangles intersect, and the cure.
constexpr std::string_view CutsOfCloud = "The surface is thinner there than its triangles are "
                                         "large, or one layer of the mesh covers two of "
                                         "the cloud. Use more vertices or another seed.";
constexpr std::string_view CutsOfSurface =
  "Parts of the surface touch or cut each other there, or lie closer than triangles are large. "
  "Remesh "
  "parts that touch or cut each other one by one. Use more vertices where parts only lie close.";

void warnOfDefects(const Reconstruction& result, std::string_view whyCut, WarningList& warnings)
{
  const std::size_t cuts = result.finish ? result.finish->left.intersectingTriangles : 0;
  const std::size_t folds = result.quality->surface.foldedEdges;
  if (cuts > 0)
  {
    warnings.add(WarningTopic::TrianglesIntersect,
      counted(cuts, "triangle intersects", "triangles intersect") +
        " others, and the repair failed. " + std::string(whyCut));
  }
  const double between = result.finish ? result.finish->shareBetweenLayers : 0.;
  if (between > MostBetweenLayers)
  {
    warnings.add(WarningTopic::BetweenLayers,
      "The mesh lies between two layers of points at " + percent(between) +
        " of its vertices. The layers are two sides of a thin part, or views that are registered "
        "badly. For a thin part, use more vertices or a first mesh with both sides. For views, "
        "repeat the registration.");
  }
  if (folds > 0)
  {
    warnings.add(WarningTopic::Folds,
      "The mesh is folded at " + counted(folds, "edge", "edges") +
        ", where it turns by more than 150 degrees. Use more FitRounds, another number of vertices "
        "or another seed.");
  }
}

/// If much of the mesh lies between two layers, warnOfDefects() has warned of that already.
void warnOfSharedNoise(const FinishReport& finish, double unit, WarningList& warnings)
{
  if (finish.sharedNoise > finish.ownNoise && !(finish.shareBetweenLayers > MostBetweenLayers))
  {
    std::ostringstream text;
    text.precision(2);
    text << "The views lie apart: the points of a view share an error of about "
         << finish.sharedNoise * unit << ", more than their own noise of " << finish.ownNoise * unit
         << ". More points do not average it out. Repeat the registration of the views. Rounded "
            "depths have the same effect.";
    warnings.add(WarningTopic::ViewsLieApart, text.str());
  }
}

void warnOfOpenBoundaries(std::size_t loops, WarningList& warnings)
{
  if (loops > 0)
  {
    warnings.add(WarningTopic::StaysOpen,
      "The mesh is not watertight: it has " + counted(loops, "boundary", "boundaries") +
        ". Almost flat sheets, and the openings of a first mesh, stay open. Scan the other side of "
        "a sheet. Otherwise use another number of vertices.");
  }
}

void warnOfMissingBars(const Reconstruction& result, WarningList& warnings)
{
  if (result.uncertainties.empty())
  {
    warnings.add(WarningTopic::NoErrorBars,
      "The mesh has no error bars: " +
        std::string(result.finish
            ? "the program took all rounds of the fit back, and error bars need a round. Use a "
              "first mesh that lies closer."
            : "the run ended before its fit. Allow more time, or remove the rules that end a run "
              "early."));
  }
}

/// If the views are unknown, a mesh between two layers is the only sign of too short error bars.
void warnOfShortBars(const Reconstruction& result, const PointCloud& cloud, WarningList& warnings)
{
  const bool isBetween = result.finish && result.finish->shareBetweenLayers > MostBetweenLayers;
  if (result.disagreeingShare > MostDisagreeing)
  {
    warnings.add(WarningTopic::ErrorBarsTooShort,
      "Views lie farther apart than estimated at " + percent(result.disagreeingShare) +
        " of the vertices, as around " + placeText(cloud.toInput(result.disagreement), cloud) +
        ". The error bars are too short there. Repeat the registration of the views.");
  }
  else if (isBetween && !result.uncertainties.empty())
  {
    warnings.add(WarningTopic::ErrorBarsTooShort,
      "The error bars are too short where the mesh lies between two layers of points. They do not "
      "include the distance of the layers.");
  }
}

void warnOfSlivers(const SurfaceReport& surface, WarningList& warnings)
{
  const double share =
    double(surface.slivers) / double(std::max<std::size_t>(1, surface.triangles));
  if (share > MostSlivers)
  {
    warnings.add(WarningTopic::Slivers,
      percent(share) + " of the triangles (" + std::to_string(surface.slivers) +
        ") are slivers, nearly lines, and the repair failed. Their normals are unreliable. Use "
        "another number of vertices or another seed. Where points are much denser than elsewhere, "
        "thin them out.");
  }
}

/// Where the points know from where they were seen, that tells more than the shape: see warnOfSides().
void warnOfTurnedParts(double share, bool areViewsKnown, WarningList& warnings)
{
  if (share > MostTurned && !areViewsKnown)
  {
    warnings.add(WarningTopic::InsideOut,
      percent(share) +
        " of the surface is inside out: it is connected to the rest by the wrong side, as where "
        "bodies touch. Use more vertices, or a cloud for each body. Then an up direction (--up) or "
        "viewpoints (--viewpoint) turn each piece.");
  }
}

/// Of some of so many places.
std::string placesText(
  const std::vector<Vector4>& places, std::size_t count, const PointCloud& cloud)
{
  std::string where;
  for (const Vector4 place : places)
  {
    where += (where.empty() ? " around " : ", ") + placeText(cloud.toInput(place), cloud);
  }
  return where + (where.empty() ? "" : otherPlaces(count, places.size()));
}

void warnOfNecks(const NarrowNecks& necks, const PointCloud& cloud, WarningList& warnings)
{
  if (necks.count > 0)
  {
    warnings.add(WarningTopic::NarrowNecks,
      "The mesh has " + counted(necks.count, "narrow neck", "narrow necks") +
        placesText(necks.places, necks.count, cloud) + ": a loop of at most " +
        std::to_string(NarrowLoop) +
        " edges parts one side from the other. If these are two bodies, they have grown together. "
        "Use more vertices, or a cloud for each body.");
  }
}

void warnOfHandles(const NarrowHandles& handles, const PointCloud& cloud, WarningList& warnings)
{
  if (handles.count == 0)
  {
    return;
  }
  const std::string where = placesText(handles.places, handles.count, cloud);
  warnings.add(WarningTopic::NarrowHandles,
    "The mesh has at least " + counted(handles.count, "narrow handle", "narrow handles") + where +
      ": a loop of at most " + std::to_string(NarrowLoop) +
      " edges leads around it. If the shape has no handle there, layers have grown together. Use a "
      "denser scan or fewer vertices.");
}

void warnOfNoiseWebs(
  const std::vector<NoiseWeb>& webs, const PointCloud& cloud, WarningList& warnings)
{
  std::size_t vertices = 0;
  double points = 0.;
  std::string where;
  for (std::size_t i = 0; i < webs.size(); ++i)
  {
    vertices += webs[i].vertices;
    points += webs[i].points;
    where += i < MostPlacesNamed ? (i == 0 ? "" : ", ") + placeText(webs[i].place, cloud) : "";
  }
  if (vertices >= FewestOnWebs)
  {
    warnings.add(WarningTopic::FinerThanNoise,
      "The noise hides holes, gaps or thin parts: the mesh has membranes that are thinner than the "
      "noise can tell around " +
        where + otherPlaces(webs.size(), MostPlacesNamed) + ", on " +
        counted(std::size_t(points) + 1, "point", "points") +
        " or less. A hole may be closed there, or parts grown together or torn. Scan these places "
        "with less noise, or average repeated scans.");
  }
}

void warnOfEarlyEnd(const Reconstruction& result, WarningList& warnings)
{
  const std::size_t vertices = result.mesh.points.size();
  if (result.stopReason == StopReason::Stalled)
  {
    warnings.add(WarningTopic::GrowthStopped,
      "The mesh stopped growing at " + std::to_string(vertices) +
        " vertices: the program removes as many vertices as it adds. Increase RemovalPatience or "
        "decrease SamplesPerAddition.");
  }
  if (result.stopReason == StopReason::TimeLimit)
  {
    warnings.add(WarningTopic::MeshIsUnfinished,
      "The time limit ended the run at " + std::to_string(vertices) +
        " vertices, before the mesh was finished. Allow more time, or use fewer vertices.");
  }
}

void warnOfVertices(const Reconstruction& result, const PointCloud& cloud, WarningList& warnings)
{
  const std::size_t vertices = result.mesh.points.size(), points = cloud.differentCount();
  const std::size_t enough = std::max(points / LeastPointsPerVertex, FewestVertices);
  if (vertices > enough && vertices <= cloud.points().size())
  {
    warnings.add(WarningTopic::FinerThanData,
      "The mesh is finer than its data: " + std::to_string(vertices) + " vertices for " +
        std::to_string(points) + " different points. A mesh of " + std::to_string(enough) +
        " vertices shows as much of the surface.");
  }
  if (result.finish && result.finish->roundsTakenBack > 0)
  {
    warnings.add(WarningTopic::FitTakenBack,
      "The program took " +
        counted(std::size_t(result.finish->roundsTakenBack), "round", "rounds") +
        " of the fit back: the residual grew, points were lost, or triangles intersected. Use "
        "fewer vertices, or a first mesh that lies closer.");
  }
}

/// Contradictions count only after the fit: before it, the mesh spans gaps, and parts that are not
/// connected may face each other.
void warnOfSides(
  const OrientationReport& sides, bool isFitted, const PointCloud& cloud, WarningList& warnings)
{
  if (isFitted && sides.contradiction)
  {
    warnings.add(WarningTopic::InsideOut,
      "Parts of the surface that face each other across openings look to opposite sides, as "
      "around " +
        placeText(cloud.toInput(*sides.contradiction), cloud) +
        ": some parts are inside out. An up direction (--up) or viewpoints (--viewpoint) turn "
        "separate pieces. If a part is connected by the wrong side, use more vertices or a cloud "
        "for each body.");
  }
  if (sides.contrary.share > MostContrary)
  {
    warnings.add(WarningTopic::InsideOut,
      percent(sides.contrary.share) +
        " of the surface shows its back to where its points were seen from, or to their normals, "
        "most clearly around " +
        placeText(cloud.toInput(sides.contrary.place), cloud) +
        ". If a part is connected by the wrong side, use more vertices or a cloud for each body. "
        "If viewpoints or normals are wrong there, correct them.");
  }
  if (sides.nestedShare > 0.)
  {
    warnings.add(WarningTopic::InsideOut,
      percent(sides.nestedShare) + " of the surface lies within another piece, as around " +
        placeText(cloud.toInput(sides.nested), cloud) +
        ", and both look outwards. If the outer one is a room, or the inner one a cavity, it "
        "should look inwards. Viewpoints (--viewpoint) or normals turn each piece.");
  }
  if (sides.isFromWithin)
  {
    warnings.add(WarningTopic::SideIsUnknown,
      "Gaps look like shadows of a scan from within, as of a room, though the surface encloses a "
      "volume. Where they are clear it looks inwards. Check its side. If that is wrong, give "
      "viewpoints (--viewpoint, where the scanner stood), or points with normals.");
  }
  if (sides.hasToldNothing(SideEvidence::Viewpoints))
  {
    warnings.add(WarningTopic::SideIsUnknown,
      "The viewpoints determine no side of the surface: they are not finite, see both sides "
      "equally, or belong to no point. Check them.");
  }
  if (sides.hasToldNothing(SideEvidence::Normals))
  {
    warnings.add(WarningTopic::SideIsUnknown,
      "The normals of the input determine no side of the surface: they are zero, not finite, or "
      "point to both sides. Check them.");
  }
  // Where the side is certain, nothing is missed.
  if (sides.hasToldNothing(SideEvidence::UpDirection) && sides.guessedShare > LeastUnknownSide)
  {
    warnings.add(WarningTopic::SideIsUnknown,
      "The up direction determines no side of the surface: as much of it looks down as up. The "
      "side is a guess. Give viewpoints (--viewpoint, where the scanner stood), or points with "
      "normals.");
  }
  // A single piece has two sides that are equally right, and the pieces that follow it agree with
  // it. A user can turn the whole mesh.
  const bool isOne = sides.unknownPieces == 1 &&
    sides.unknownShare() + sides.share(SideEvidence::Neighbors) > WholeArea;
  if (sides.unknownShare() > LeastUnknownSide && !isOne)
  {
    warnings.add(WarningTopic::SideIsUnknown,
      "The outer side is unknown for " + counted(sides.unknownPieces, "piece", "pieces") +
        " with " + percent(sides.unknownShare()) +
        " of the area. Give viewpoints (--viewpoint, where the scanner stood), an up direction "
        "(--up), or points with normals.");
  }
}
}

std::vector<std::string> warningsOf(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters)
{
  WarningList warnings;
  // With such points the others may seem to lie on a line.
  warnOfNoDataValue(cloud, warnings);
  if (areOnLine(cloud))
  {
    // All else follows from it.
    warnings.add(WarningTopic::NoSurface,
      "All points lie on a line, so they have no surface. Check which columns are x, y and z.");
    return warnings.take();
  }
  if (result.quality)
  {
    // First, as others may follow from it.
    warnOfEarlyEnd(result, warnings);
  }
  warnOfPiles(cloud, warnings);
  if (result.explanation)
  {
    warnOfPoints(*result.explanation, cloud, result.mesh.points.size(), warnings);
  }
  if (parameters.boundaries == Boundaries::Keep && parameters.closeHolesBelow == 0.)
  {
    warnOfBareArea(bareShare(result.mesh, result.support), warnings);
    warnOfBarePieces(result.surface, result.support, cloud, warnings);
    warnOfGaps(result.gaps, cloud, warnings);
  }
  if (result.quality)
  {
    if (parameters.boundaries == Boundaries::Close)
    {
      warnOfOpenBoundaries(result.quality->surface.boundaryLoops, warnings);
    }
    warnOfDefects(result, CutsOfCloud, warnings);
    warnOfSlivers(result.quality->surface, warnings);
    warnOfTurnedParts(result.quality->turnedShare, result.orientation.areViewsKnown, warnings);
    warnOfHandles(result.quality->narrowHandles, cloud, warnings);
    warnOfNecks(result.quality->narrowNecks, cloud, warnings);
    warnOfVertices(result, cloud, warnings);
  }
  warnOfNoiseWebs(result.noiseWebs, cloud, warnings);
  if (parameters.computeUncertainty && result.stopReason != StopReason::Cancelled)
  {
    warnOfMissingBars(result, warnings);
    warnOfShortBars(result, cloud, warnings);
  }
  if (result.finish)
  {
    warnOfSharedNoise(*result.finish, cloud.unit(), warnings);
  }
  warnOfSides(result.orientation, result.finish.has_value(), cloud, warnings);
  return warnings.take();
}

std::vector<std::string> warningsOfSurface(
  const Reconstruction& result, const Parameters& parameters)
{
  if (!result.quality)
  {
    return {};
  }
  WarningList warnings;
  const std::size_t vertices = result.mesh.points.size();
  warnOfDefects(result, CutsOfSurface, warnings);
  warnOfSlivers(result.quality->surface, warnings);
  if (vertices != parameters.numberOfVertices)
  {
    warnings.add(WarningTopic::OtherNumberOfVertices,
      "The mesh has " + std::to_string(vertices) + " vertices, not " +
        std::to_string(parameters.numberOfVertices) +
        ": its pieces, handles and boundaries need them.");
  }
  return warnings.take();
}

std::string warningOfFirst(const Mesh& first, const Parameters& parameters)
{
  if (first.vertexCount() <= parameters.numberOfVertices)
  {
    return "";
  }
  return taggedWarning(WarningTopic::FirstMesh,
    "The first mesh has " + std::to_string(first.vertexCount()) + " vertices, more than " +
      std::to_string(parameters.numberOfVertices) +
      (parameters.fitRounds > 0 ? ": the program fits it, but adds no vertices."
                                : ": it is the output, unchanged."));
}
}
