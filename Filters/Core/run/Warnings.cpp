// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

#include "base/WarningTopic.h"
#include "mesh/Pieces.h"
#include "run/BareArea.h"

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
constexpr double MostUnexplained = 0.03;
/// Of the vertices.
constexpr double MostBetweenLayers = 0.1;
/// Of the area: less is not worth a word.
constexpr double LeastUnknownSide = 0.001;
constexpr double MostTurned = 0.005;
/// Of the area: bridges over gaps have less.
constexpr double MostBare = 0.04;
/// ... and so has one bridge.
constexpr double LeastGap = 0.0002;
/// Of the points.
constexpr double MostScattered = 0.5;
constexpr double MostAtRims = 0.00035;
/// Of those asked: fewer are cut off by chance.
constexpr std::size_t FewestAtRims = 4;
constexpr std::size_t FewestBeyondEnds = 6;
/// Of the triangles.
constexpr double MostSlivers = 0.002;
constexpr double WholeArea = 0.999;
/// Of the vertices.
constexpr double MostDisagreeing = 0.02;
/// Named in one sentence; the others are counted.
constexpr std::size_t MostPiecesNamed = 2;
/// With less points a vertex, the mesh follows single points.
constexpr std::size_t LeastPointsPerVertex = 2;
/// Of a closed mesh.
constexpr std::size_t FewestVertices = 4;
constexpr std::string_view HowToSee = "ExplainPoints (--explain) marks these points.";

std::string counted(std::size_t count, std::string_view one, std::string_view several)
{
  return std::to_string(count) + " " + std::string(count == 1 ? one : several);
}

std::string percent(double share)
{
  std::ostringstream text;
  text.precision(share > 0.1 ? 3 : 2);
  text << 100. * share << " %";
  return text.str();
}

std::string about(double points) { return std::to_string(std::llround(points)); }

/// A place as a user would type it, in digits that tell it apart from others of the cloud.
std::string placeText(const Eigen::Vector3d& place, const PointCloud& cloud)
{
  const double step = std::max(1e-3 * cloud.diagonal() * cloud.unit(), 1e-300);
  const double largest = std::max(place.cwiseAbs().maxCoeff(), step);
  std::ostringstream text;
  text.precision(1 + int(std::ceil(std::log10(largest / step))));
  text << "(" << place[0] << ", " << place[1] << ", " << place[2] << ")";
  return text.str();
}

/// What has become of a piece of the cloud.
enum class Fate
{
  Missing,
  BeyondBoundary,
  Coarse
};

Fate fateOf(const MissedPiece& piece, double meanEdge)
{
  return piece.isBeyondBoundary ? Fate::BeyondBoundary
    : piece.isCoarse(meanEdge)  ? Fate::Coarse
                                : Fate::Missing;
}

/// How many points are where: the largest pieces by their places, the others by their number.
std::string piecesText(const std::vector<MissedPiece>& pieces, const PointCloud& cloud)
{
  std::string where = "about ";
  for (std::size_t i = 0; i < std::min(pieces.size(), MostPiecesNamed); ++i)
  {
    where += (i == 0 ? "" : ", ") + about(pieces[i].points) + " points around " +
      placeText(pieces[i].center, cloud);
  }
  if (pieces.size() > MostPiecesNamed)
  {
    where += " and " + counted(pieces.size() - MostPiecesNamed, "other place", "other places");
  }
  return where + ". ";
}

/// "about 120 points, the farthest around (0, 0, 1) by 0.02. ".
std::string cutOffText(
  const CutOffPoints& points, const Explanation& explanation, const PointCloud& cloud)
{
  std::ostringstream text;
  text.precision(2);
  text << "about "
       << about(double(points.count) * double(cloud.points().size()) /
            double(explanation.reasons.size()))
       << " points, the farthest around " << placeText(points.place, cloud) << " by "
       << points.farthest << ". ";
  return text.str();
}

/// A piece of the kind has its own warning.
void warnOfCutOff(const Explanation& explanation, const PointCloud& cloud, WarningList& warnings)
{
  const double meanEdge = explanation.asked.meanEdge * cloud.unit();
  const auto names = [&](Fate fate)
  {
    return std::any_of(explanation.pieces.begin(), explanation.pieces.end(),
      [&](const MissedPiece& piece) { return fateOf(piece, meanEdge) == fate; });
  };
  const std::size_t atRims = explanation.atRims.count;
  if (atRims >= FewestAtRims && double(atRims) > MostAtRims * double(explanation.reasons.size()) &&
    !names(Fate::Coarse))
  {
    warnings.add(WarningTopic::MeshIsCoarse,
      "The mesh is coarser than its cloud: it cuts off " +
        cutOffText(explanation.atRims, explanation, cloud) +
        "The surface is narrower there than edges are long. Use more vertices.");
  }
  if (explanation.beyondEnds.count >= FewestBeyondEnds && !names(Fate::BeyondBoundary))
  {
    warnings.add(WarningTopic::OpenWherePointsAre,
      "The mesh is open where there are points: it does not reach " +
        cutOffText(explanation.beyondEnds, explanation, cloud) +
        "Points are sparse there. Use more vertices, or scan more points.");
  }
}

void warnOfPieces(
  const Explanation& explanation, const PointCloud& cloud, Fate fate, WarningList& warnings)
{
  const double meanEdge = explanation.asked.meanEdge * cloud.unit();
  std::vector<MissedPiece> pieces;
  std::copy_if(explanation.pieces.begin(), explanation.pieces.end(), std::back_inserter(pieces),
    [&](const MissedPiece& piece) { return fateOf(piece, meanEdge) == fate; });
  if (pieces.empty())
  {
    return;
  }
  const std::string where = piecesText(pieces, cloud), how(HowToSee);
  switch (fate)
  {
    case Fate::Missing:
      warnings.add(WarningTopic::PartIsMissing,
        "A part of the cloud is missing in the mesh: " + where +
          "The triangles are too large for a thin or narrow part. Use more vertices, or a first "
          "mesh that has the part. " +
          how);
      return;
    case Fate::BeyondBoundary:
      warnings.add(WarningTopic::OpenWherePointsAre,
        "The mesh is open where there are points: " + where +
          "The triangles are too large for a thin or narrow part. Use more vertices, or close "
          "openings (--boundaries close). " +
          how);
      return;
    case Fate::Coarse:
      warnings.add(WarningTopic::MeshIsCoarse,
        "The mesh is coarser than its cloud: " + where +
          "They lie up to half an edge from the mesh. Use more vertices to resolve narrow or bent "
          "parts. " +
          how);
      return;
  }
}

void warnOfPoints(const Explanation& explanation, const PointCloud& cloud, WarningList& warnings)
{
  // The noise is unknown where the mesh misses the cloud.
  if (explanation.scatteredShare > MostScattered && explanation.unexplainedShare() < MostScattered)
  {
    warnings.add(WarningTopic::NoSurface,
      "The cloud has no recognizable surface: around " + percent(explanation.scatteredShare) +
        " of its points, other points lie in all directions, as in noise. The position of the "
        "mesh is a guess. Remove points that lie on no surface, or provide more points.");
  }
  if (explanation.unexplainedShare() > MostUnexplained)
  {
    warnings.add(WarningTopic::PointsAreUnexplained,
      percent(explanation.unexplainedShare()) + " of the points (about " +
        about(explanation.unexplained()) +
        ") are unexplained: they lie farther from the mesh than from each other, and they are no "
        "outliers. Look at them before you use the mesh. " +
        std::string(HowToSee));
  }
  for (const Fate fate : { Fate::Missing, Fate::BeyondBoundary, Fate::Coarse })
  {
    warnOfPieces(explanation, cloud, fate, warnings);
  }
  warnOfCutOff(explanation, cloud, warnings);
}

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

/// However little area a piece has, it is no surface of the cloud where none of its vertices rests on points.
void warnOfBarePieces(
  const Mesh& surface, const VertexSupport& support, const PointCloud& cloud, WarningList& warnings)
{
  if (support.weights.size() != surface.vertexCount())
  {
    return;
  }
  std::size_t count = 0;
  Vector4 place;
  for (const Piece& piece : findPieces(surface))
  {
    if (std::all_of(piece.vertices.begin(), piece.vertices.end(),
          [&](VertexIndex v) { return !(support.weights[v] > 0.); }))
    {
      place = count == 0 ? surface.position(piece.vertices.front()) : place;
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
  for (std::size_t i = 0; i < std::min(gaps.size(), MostPiecesNamed); ++i)
  {
    where += (i == 0 ? "" : ", ") + percent(gaps[i].share) + " of the surface around " +
      placeText(gaps[i].center, cloud);
  }
  if (gaps.size() > MostPiecesNamed)
  {
    where += " and " + counted(gaps.size() - MostPiecesNamed, "other place", "other places");
  }
  warnings.add(WarningTopic::GapIsSpanned,
    "The mesh spans gaps of the cloud: " + where +
      ". The nearest points are farther away than three times their spacing, so the surface is a "
      "guess. Scan these places, or remove the triangles there. If gaps are to be filled, use "
      "--boundaries close.");
}

/// Why triangles intersect, and what helps.
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

/// Where most of the mesh lies between two layers, another warning has said so.
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

/// Without views, a mesh between two layers is the only sign.
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

void warnOfTurnedParts(double share, WarningList& warnings)
{
  if (share > MostTurned)
  {
    warnings.add(WarningTopic::InsideOut,
      percent(share) +
        " of the surface is inside out: it is connected to the rest by the wrong side, as where "
        "bodies touch. Use more vertices, or a cloud for each body. Then an up direction (--up) or "
        "viewpoints (--viewpoint) turn each piece.");
  }
}

void warnOfHandles(const NarrowHandles& handles, const PointCloud& cloud, WarningList& warnings)
{
  if (handles.count == 0)
  {
    return;
  }
  std::string where;
  for (const Vector4 place : handles.places)
  {
    where += (where.empty() ? " around " : ", ") + placeText(cloud.toInput(place), cloud);
  }
  if (handles.count > handles.places.size() && !where.empty())
  {
    where +=
      " and " + counted(handles.count - handles.places.size(), "other place", "other places");
  }
  warnings.add(WarningTopic::NarrowHandles,
    "The mesh has at least " + counted(handles.count, "narrow handle", "narrow handles") + where +
      ": a loop of at most " + std::to_string(NarrowLoop) +
      " edges leads around it. If the shape has no handle there, layers have grown together. Use a "
      "denser scan or fewer vertices.");
}

void warnOfVertices(const Reconstruction& result, const PointCloud& cloud, WarningList& warnings)
{
  const std::size_t vertices = result.mesh.points.size(), points = cloud.differentCount();
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

/// Before the fit, gaps are spanned, and parts may face each other that are not connected.
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
  // One piece agrees with itself and with the pieces that follow it: as a whole, it has two sides that
  // are equally right.
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
  if (result.explanation)
  {
    warnOfPoints(*result.explanation, cloud, warnings);
  }
  if (parameters.boundaries == Boundaries::Keep && parameters.closeHolesBelow == 0.)
  {
    warnOfBareArea(bareShare(result.mesh, result.support), warnings);
    warnOfBarePieces(result.surface, result.support, cloud, warnings);
    warnOfGaps(result.gaps, cloud, warnings);
  }
  if (result.quality)
  {
    warnOfDefects(result, CutsOfCloud, warnings);
    warnOfSlivers(result.quality->surface, warnings);
    warnOfTurnedParts(result.quality->turnedShare, warnings);
    warnOfHandles(result.quality->narrowHandles, cloud, warnings);
    warnOfVertices(result, cloud, warnings);
  }
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
