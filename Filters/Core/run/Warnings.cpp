// SPDX-License-Identifier: BSD-3-Clause
#include "run/Warnings.h"

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
constexpr std::string_view HowToSee = "ExplainPoints (--explain) shows which.";

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

void warnOfPieces(const Explanation& explanation, const PointCloud& cloud, Fate fate,
  std::vector<std::string>& warnings)
{
  const double meanEdge = explanation.asked.meanEdge * cloud.unit();
  std::vector<MissedPiece> pieces;
  std::copy_if(explanation.pieces.begin(), explanation.pieces.end(), std::back_inserter(pieces),
    [&](const MissedPiece& piece) { return fateOf(piece, meanEdge) == fate; });
  if (pieces.empty())
  {
    return;
  }
  std::string where;
  for (std::size_t i = 0; i < std::min(pieces.size(), MostPiecesNamed); ++i)
  {
    where += (i == 0 ? "" : ", ") + about(pieces[i].points) + " points around " +
      placeText(pieces[i].center, cloud);
  }
  if (pieces.size() > MostPiecesNamed)
  {
    where += " and " + counted(pieces.size() - MostPiecesNamed, "other place", "other places");
  }
  constexpr std::array<std::string_view, 3> What{ "A part of the cloud is missing in the mesh",
    "The mesh ends, or is open, where there are points", "The mesh is coarser than its cloud" };
  constexpr std::array<std::string_view, 3> WhatHelps{
    "More vertices reach what is thin or narrow, a first mesh holds what is lost.",
    "More vertices reach what is thin or narrow, Boundaries close fills openings.",
    "It is up to half an edge away from them: more vertices show what is narrow or bent there."
  };
  warnings.push_back(std::string(What[std::size_t(fate)]) + ": about " + where + ". " +
    std::string(WhatHelps[std::size_t(fate)]) + " " + std::string(HowToSee));
}

/// "about 120 points, the farthest around (0, 0, 1) by 0.02".
std::string cutOffText(
  const CutOffPoints& points, const Explanation& explanation, const PointCloud& cloud)
{
  std::ostringstream text;
  text.precision(2);
  text << "about "
       << about(double(points.count) * double(cloud.points().size()) /
            double(explanation.reasons.size()))
       << " points, the farthest around " << placeText(points.place, cloud) << " by "
       << points.farthest;
  return text.str();
}

/// Where a piece of the kind is named, that is told already.
void warnOfCutOff(
  const Explanation& explanation, const PointCloud& cloud, std::vector<std::string>& warnings)
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
    warnings.push_back("The mesh is coarser than its cloud: it cuts off " +
      cutOffText(explanation.atRims, explanation, cloud) +
      ". Edges are longer there than the surface is narrow: more vertices show it.");
  }
  if (explanation.beyondEnds.count >= FewestBeyondEnds && !names(Fate::BeyondBoundary))
  {
    warnings.push_back("The mesh ends, or is open, where there are points: it does not reach " +
      cutOffText(explanation.beyondEnds, explanation, cloud) +
      ". Points are sparse there: more vertices, or more points, show where they end.");
  }
}

void warnOfPoints(
  const Explanation& explanation, const PointCloud& cloud, std::vector<std::string>& warnings)
{
  // A mesh that misses the cloud tells nothing of its noise.
  if (explanation.scatteredShare > MostScattered && explanation.unexplainedShare() < MostScattered)
  {
    warnings.push_back("The cloud has no surface, as far as this mesh can tell: around " +
      percent(explanation.scatteredShare) +
      " of its points others lie in all directions, as noise does. The mesh lies somewhere among "
      "them. Look at the points, and take away what is no surface; where there is one under the "
      "noise, more points may show it.");
  }
  if (explanation.unexplainedShare() > MostUnexplained)
  {
    warnings.push_back(percent(explanation.unexplainedShare()) + " of the points (about " +
      about(explanation.unexplained()) +
      ") are unexplained: farther from the mesh than from each other, and no outliers. Look at "
      "them before you use the mesh. " +
      std::string(HowToSee));
  }
  for (const Fate fate : { Fate::Missing, Fate::BeyondBoundary, Fate::Coarse })
  {
    warnOfPieces(explanation, cloud, fate, warnings);
  }
  warnOfCutOff(explanation, cloud, warnings);
}

void warnOfBareArea(double share, std::vector<std::string>& warnings)
{
  if (share > MostBare)
  {
    warnings.push_back(percent(share) +
      " of the surface has hardly any points: its triangles reach out to stray points, or across "
      "gaps. Look at it before you use the mesh: where the point data Support is 0. Cut points off "
      "that do not belong to the scan, and take bodies that are far apart one by one.");
  }
}

void warnOfGaps(
  std::vector<SpannedGap> gaps, const PointCloud& cloud, std::vector<std::string>& warnings)
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
  warnings.push_back("The mesh spans gaps of the cloud: " + where +
    ", farther from all points than three times as far as these are from each other. There it is "
    "a guess. Scan what is missing there; if there is nothing, cut it out: where Support is 0.");
}

void warnOfDefects(const Reconstruction& result, std::vector<std::string>& warnings)
{
  const std::size_t cuts = result.finish ? result.finish->left.intersectingTriangles : 0;
  const std::size_t folds = result.quality->surface.foldedEdges;
  if (cuts > 0)
  {
    warnings.push_back(counted(cuts, "triangle intersects", "triangles intersect") +
      " others and could not be repaired: the surface is thinner there than triangles are large, "
      "or two layers are taken for one. More vertices make triangles smaller; another seed may "
      "do.");
  }
  const double between = result.finish ? result.finish->shareBetweenLayers : 0.;
  if (between > MostBetweenLayers)
  {
    warnings.push_back("The mesh lies between two layers of points at " + percent(between) +
      " of its vertices: two sides of a thin part are taken for one, or views of the same surface "
      "lie "
      "apart. For a thin part more vertices may do, or a first mesh with both sides; views can be "
      "registered anew.");
  }
  if (folds > 0)
  {
    warnings.push_back("The mesh is folded at " + counted(folds, "edge", "edges") +
      ", whose triangles turn by more than 150 degrees. More FitRounds, another number of vertices "
      "or another seed may unfold it.");
  }
}

/// Where most of the mesh lies between two layers, that is told already.
void warnOfSharedNoise(const FinishReport& finish, double unit, std::vector<std::string>& warnings)
{
  if (finish.sharedNoise > finish.ownNoise && !(finish.shareBetweenLayers > MostBetweenLayers))
  {
    std::ostringstream text;
    text.precision(2);
    text
      << "The points of a view are off together by more (about " << finish.sharedNoise * unit
      << ") than each of them for itself (" << finish.ownNoise * unit
      << "): views of the same surface lie apart. More points do not average that out; views can "
         "be registered anew. Depths that are rounded look the same.";
    warnings.push_back(text.str());
  }
}

void warnOfMissingBars(const Reconstruction& result, std::vector<std::string>& warnings)
{
  if (result.uncertainties.empty())
  {
    warnings.push_back("The mesh has no error bars: " +
      std::string(result.finish
          ? "all rounds of the fit were taken back, and they are those of the fit."
          : "the run ended before its fit. More time, or none of the rules that end a run early, "
            "may help."));
  }
}

/// Without views, what lies between two layers is all that tells it.
void warnOfShortBars(
  const Reconstruction& result, const PointCloud& cloud, std::vector<std::string>& warnings)
{
  const bool isBetween = result.finish && result.finish->shareBetweenLayers > MostBetweenLayers;
  if (result.disagreeingShare > MostDisagreeing)
  {
    warnings.push_back("Views lie apart by more than was estimated at " +
      percent(result.disagreeingShare) + " of the vertices, as around " +
      placeText(cloud.toInput(result.disagreement), cloud) +
      ": error bars are too short there. Views can be registered anew.");
  }
  else if (isBetween && !result.uncertainties.empty())
  {
    warnings.push_back("Where the mesh lies between two layers of points, error bars are too "
                       "short: they take what is between for the surface.");
  }
}

void warnOfSlivers(const SurfaceReport& surface, std::vector<std::string>& warnings)
{
  const double share =
    double(surface.slivers) / double(std::max<std::size_t>(1, surface.triangles));
  if (share > MostSlivers)
  {
    warnings.push_back(percent(share) + " of the triangles (" + std::to_string(surface.slivers) +
      ") are slivers, nearly lines, and could not be taken away: their normals tell nothing. "
      "Another number of vertices or another seed may do without; where points are far denser "
      "than elsewhere, thin them there.");
  }
}

void warnOfTurnedParts(double share, std::vector<std::string>& warnings)
{
  if (share > MostTurned)
  {
    warnings.push_back(percent(share) +
      " of the surface is inside out: it hangs on to the rest by the wrong side, as bodies do that "
      "touch each other. More vertices may part them, and so does a cloud for each body; then an "
      "up direction (--up) or viewpoints (--viewpoint) turn each of them.");
  }
}

void warnOfHandles(
  const NarrowHandles& handles, const PointCloud& cloud, std::vector<std::string>& warnings)
{
  if (handles.count == 0)
  {
    return;
  }
  std::string where;
  for (const Vector4 place : handles.places)
  {
    where += (where.empty() ? ": around " : ", ") + placeText(cloud.toInput(place), cloud);
  }
  if (handles.count > handles.places.size() && !where.empty())
  {
    where +=
      " and " + counted(handles.count - handles.places.size(), "other place", "other places");
  }
  warnings.push_back("A loop of " + std::to_string(NarrowLoop) +
    " edges at most leads around at least " + counted(handles.count, "handle", "handles") + where +
    ". Unless the shape is as narrow there, layers have grown together. A denser scan or fewer "
    "vertices may help.");
}

void warnOfVertices(
  const Reconstruction& result, const PointCloud& cloud, std::vector<std::string>& warnings)
{
  const std::size_t vertices = result.mesh.points.size(), points = cloud.differentCount();
  if (result.stopReason == StopReason::Stalled)
  {
    warnings.push_back("The mesh has stopped growing, at " + std::to_string(vertices) +
      " vertices: as many are removed as are added. More RemovalPatience or less "
      "SamplesPerAddition may help.");
  }
  const std::size_t enough = std::max(points / LeastPointsPerVertex, FewestVertices);
  if (vertices > enough && vertices <= cloud.points().size())
  {
    warnings.push_back("The mesh is finer than its data: " + std::to_string(vertices) +
      " vertices for " + std::to_string(points) +
      " different points. It shows no more of the surface than with " + std::to_string(enough) +
      ".");
  }
  if (result.finish && result.finish->roundsTakenBack > 0)
  {
    warnings.push_back(counted(std::size_t(result.finish->roundsTakenBack), "round", "rounds") +
      " of the fit made the residual larger, lost points or made triangles intersect, and were "
      "taken back. Fewer vertices, or a first mesh that lies closer, may help.");
  }
}

/// Before the fit, gaps are spanned, and parts may face each other that do not hang together.
void warnOfSides(const OrientationReport& sides, bool isFitted, const PointCloud& cloud,
  std::vector<std::string>& warnings)
{
  if (isFitted && sides.contradiction)
  {
    warnings.push_back("Parts of the surface that face each other across openings look to opposite "
                       "sides, as around " +
      placeText(cloud.toInput(*sides.contradiction), cloud) +
      ": some are inside out, and nothing tells which. An up direction (--up) or viewpoints "
      "(--viewpoint) turn pieces; what hangs on to its piece by the wrong side takes more "
      "vertices, or a cloud of its own.");
  }
  if (sides.hasToldNothing(SideEvidence::Viewpoints))
  {
    warnings.push_back("The viewpoints tell nothing of the sides of the surface: they are not "
                       "finite, see as much of either side, or are those of no point.");
  }
  if (sides.hasToldNothing(SideEvidence::Normals))
  {
    warnings.push_back(
      "The normals of the input tell nothing of the sides of the surface: they are "
      "zero, not finite, or point to either side.");
  }
  // One piece agrees with itself, and with those that follow it: as a whole it has two sides that are
  // as right.
  const bool isOne = sides.unknownPieces == 1 &&
    sides.unknownShare() + sides.share(SideEvidence::Neighbors) > WholeArea;
  if (sides.unknownShare() > LeastUnknownSide && !isOne)
  {
    warnings.push_back("Which side of the surface is the outer one is unknown for " +
      counted(sides.unknownPieces, "piece", "pieces") + " with " + percent(sides.unknownShare()) +
      " of the area: give viewpoints (--viewpoint, where the scanner stood), an up direction "
      "(--up), or points with normals.");
  }
}
}

std::vector<std::string> warningsOf(
  const Reconstruction& result, const PointCloud& cloud, const Parameters& parameters)
{
  std::vector<std::string> warnings;
  if (result.explanation)
  {
    warnOfPoints(*result.explanation, cloud, warnings);
  }
  if (parameters.boundaries == Boundaries::Keep && parameters.closeHolesBelow == 0.)
  {
    warnOfBareArea(bareShare(result.mesh, result.support), warnings);
    warnOfGaps(result.gaps, cloud, warnings);
  }
  if (result.quality)
  {
    warnOfDefects(result, warnings);
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
  return warnings;
}

std::vector<std::string> warningsOfSurface(
  const Reconstruction& result, const Parameters& parameters)
{
  std::vector<std::string> warnings;
  const std::size_t vertices = result.mesh.points.size();
  if (!result.quality)
  {
    return warnings;
  }
  warnOfDefects(result, warnings);
  warnOfSlivers(result.quality->surface, warnings);
  if (vertices != parameters.numberOfVertices)
  {
    warnings.push_back("The mesh has " + std::to_string(vertices) + " vertices, not " +
      std::to_string(parameters.numberOfVertices) +
      ": its pieces, handles and boundaries need so many.");
  }
  return warnings;
}

std::string warningOfFirst(const Mesh& first, const Parameters& parameters)
{
  if (first.vertexCount() <= parameters.numberOfVertices)
  {
    return "";
  }
  return "The mesh to start from has " + std::to_string(first.vertexCount()) +
    " vertices, more than " + std::to_string(parameters.numberOfVertices) +
    (parameters.fitRounds > 0 ? ": it is fitted, but grows no further."
                              : ": it comes out as it is.");
}
}
