// SPDX-License-Identifier: BSD-3-Clause
#include "run/PointWarnings.h"

#include "cloud/NoDataValue.h"
#include "run/WarningTexts.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh
{
namespace
{
constexpr double MostUnexplained = 0.03;
/// Of the points.
constexpr double MostScattered = 0.5;
constexpr double MostAtRims = 0.00035;
/// Of those asked: fewer are cut off by chance.
constexpr std::size_t FewestAtRims = 4;
constexpr std::size_t FewestBeyondEnds = 6;
/// Single points lie about a cluster, too.
constexpr std::size_t FewestLeftOut = 32;
/// Of the most vertices that are not finer than the data.
constexpr double MostOfUseful = 0.8;
constexpr std::string_view HowToSee = "ExplainPoints (--explain) marks these points.";

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

std::vector<MissedPiece> piecesOf(
  Fate fate, const Explanation& explanation, const PointCloud& cloud)
{
  const double meanEdge = explanation.asked.meanEdge * cloud.unit();
  std::vector<MissedPiece> pieces;
  std::copy_if(explanation.pieces.begin(), explanation.pieces.end(), std::back_inserter(pieces),
    [&](const MissedPiece& piece) { return fateOf(piece, meanEdge) == fate; });
  return pieces;
}

/// The number of points in each of the largest pieces with its place, and the number of the other pieces.
std::string piecesText(const std::vector<MissedPiece>& pieces, const PointCloud& cloud)
{
  std::string where = "about ";
  for (std::size_t i = 0; i < std::min(pieces.size(), MostPlacesNamed); ++i)
  {
    where += (i == 0 ? "" : ", ") + about(pieces[i].points) + " points around " +
      placeText(pieces[i].center, cloud);
  }
  return where + otherPlaces(pieces.size(), MostPlacesNamed) + ". ";
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

/// A mesh of nearly as many vertices as the cloud shows needs more points to have more.
std::string howToResolve(const PointCloud& cloud, std::size_t vertices)
{
  const bool mayHaveMore =
    double(vertices * LeastPointsPerVertex) < MostOfUseful * double(cloud.differentCount());
  return mayHaveMore ? "Use more vertices." : "Scan more points, and use more vertices then.";
}

/// Warns of single points that the mesh cuts off. A piece of the same fate has its own warning, with the same
/// tag: then this one is left out.
void warnOfCutOff(const Explanation& explanation, const PointCloud& cloud, std::size_t vertices,
  WarningList& warnings)
{
  const std::size_t atRims = explanation.atRims.count;
  const bool areMany =
    atRims >= FewestAtRims && double(atRims) > MostAtRims * double(explanation.reasons.size());
  const bool isCutOff = areMany || explanation.atRims.together;
  const bool hasCoarsePiece = !piecesOf(Fate::Coarse, explanation, cloud).empty();
  if (isCutOff && !hasCoarsePiece)
  {
    warnings.add(WarningTopic::MeshIsCoarse,
      "The mesh is coarser than its cloud: it cuts off " +
        (areMany ? cutOffText(explanation.atRims, explanation, cloud)
                 : "points that lie together, as around " +
              placeText(*explanation.atRims.together, cloud) + ". ") +
        "The surface is narrower there than edges are long. " + howToResolve(cloud, vertices));
  }
  if (!explanation.passedBy.empty() && !isCutOff && !hasCoarsePiece)
  {
    warnings.add(WarningTopic::MeshIsCoarse,
      "The mesh passes by points that belong together: " + piecesText(explanation.passedBy, cloud) +
        "A narrow hole may be closed there, or a narrow part cut off. Use more vertices, or scan "
        "more points.");
  }
  if (explanation.beyondEnds.count >= FewestBeyondEnds &&
    piecesOf(Fate::BeyondBoundary, explanation, cloud).empty())
  {
    warnings.add(WarningTopic::OpenWherePointsAre,
      "The mesh is open where there are points: it does not reach " +
        cutOffText(explanation.beyondEnds, explanation, cloud) +
        "Points are sparse there. Use more vertices, or scan more points.");
  }
}

void warnOfPieces(Fate fate, const Explanation& explanation, const PointCloud& cloud,
  std::size_t vertices, WarningList& warnings)
{
  const std::vector<MissedPiece> pieces = piecesOf(fate, explanation, cloud);
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
          "They lie up to half an edge from the mesh, at narrow or bent parts. " +
          howToResolve(cloud, vertices) + " " + how);
      return;
  }
}

/// What has few points is dropped with what is strewn; here it is more.
void warnOfSmallParts(
  const Explanation& explanation, const PointCloud& cloud, WarningList& warnings)
{
  if (!explanation.smallParts.empty())
  {
    warnings.add(WarningTopic::PartIsMissing,
      "A small part of the cloud is missing in the mesh: " +
        piecesText(explanation.smallParts, cloud) +
        "These points lie as dense as others and form a surface, but they are so few that the "
        "program takes them for stray points. If the part belongs to the scan, keep small pieces "
        "(--keep-pieces 0). " +
        std::string(HowToSee));
  }
}

void warnOfLeftOut(const Explanation& explanation, const PointCloud& cloud, WarningList& warnings)
{
  if (explanation.leftOutPoints >= FewestLeftOut)
  {
    warnings.add(WarningTopic::PartIsMissing,
      counted(explanation.leftOutPoints, "point", "points") +
        " that lie together were left out, as around " +
        placeText(explanation.leftOutPlace, cloud) +
        ": they fill a space and form no surface. If they are a part of the scan, keep them "
        "(--keep-pieces 0). " +
        std::string(HowToSee));
  }
}

void warnOfTornParts(const TornParts& torn, const PointCloud& cloud, WarningList& warnings)
{
  if (torn.any())
  {
    warnings.add(WarningTopic::FallsIntoPieces,
      "The mesh falls into pieces where the points are connected: it is torn at " +
        counted(torn.tears, "place", "places") + ", as around " + placeText(torn.place, cloud) +
        ". Points are sparse there, or the part is narrower than edges are long. Use more "
        "vertices, more points, or another seed.");
  }
}
}

void warnOfNoDataValue(const PointCloud& cloud, WarningList& warnings)
{
  if (const auto found = findNoDataValue(cloud))
  {
    std::ostringstream text;
    text << found->count << " points have the same "
         << "xyz"[found->axis] << ", about " << found->value
         << ", far from all others. Such a number often stands for \"not measured\". If it does, "
            "remove these points.";
    warnings.add(WarningTopic::UnmeasuredPoints, text.str());
  }
}

void warnOfPiles(const PointCloud& cloud, WarningList& warnings)
{
  if (cloud.pileCount() > 0)
  {
    const Pile& largest = cloud.largestPile();
    warnings.add(WarningTopic::PointsCoincide,
      counted(cloud.coincidingCount(), "point was", "points were") +
        " dropped, as they lie exactly where others do: " + std::to_string(largest.count) +
        " points are at " + placeText(largest.place, cloud) +
        (cloud.pileCount() > 1
            ? ", others at " + counted(cloud.pileCount() - 1, "other place", "other places")
            : "") +
        ". Depth cameras write (0, 0, 0) for pixels without a measurement. Remove such points. One "
        "of each place has stayed.");
  }
}

void warnOfPoints(const Explanation& explanation, const PointCloud& cloud, std::size_t vertices,
  WarningList& warnings)
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
    warnOfPieces(fate, explanation, cloud, vertices, warnings);
  }
  warnOfSmallParts(explanation, cloud, warnings);
  warnOfLeftOut(explanation, cloud, warnings);
  warnOfCutOff(explanation, cloud, vertices, warnings);
  warnOfTornParts(explanation.torn, cloud, warnings);
}
}
