// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Arrays.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <limits>
#include <string>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
std::string textOf(std::string_view text) { return std::string(text); }
}

nb::dict meshOf(const TriangleMesh& mesh, bool isDouble)
{
  nb::dict result;
  result["points"] = isDouble ? rowsOf<double>(mesh.points) : rowsOf<float>(mesh.points);
  result["triangles"] = trianglesOf(mesh);
  result["point_data"] = nb::dict();
  return result;
}

nb::dict meshOf(const Reconstruction& result, bool isDouble)
{
  nb::dict mesh = meshOf(result.mesh, isDouble);
  nb::dict data;
  data["Normals"] = rowsOf<float>(result.normals);
  data["Activity"] = arrayOf(result.activities);
  std::vector<std::uint8_t> boundary(result.surface.indexEnd());
  for (VertexIndex v = 0; v < boundary.size(); ++v)
  {
    boundary[v] = result.surface.isBoundary(v) ? 1 : 0;
  }
  data["Boundary"] = arrayOf(std::move(boundary));
  if (!result.support.weights.empty())
  {
    data["Residual"] = arrayOf(result.support.residuals);
    data["Support"] = arrayOf(result.support.weights);
  }
  if (!result.featureStrengths.empty())
  {
    data["FeatureStrength"] = arrayOf(result.featureStrengths);
  }
  if (!result.uncertainties.empty())
  {
    data["Uncertainty"] = arrayOf(result.uncertainties);
  }
  mesh["point_data"] = data;
  return mesh;
}

nb::dict meshOf(const GrowthSnapshot& snapshot, bool isDouble)
{
  const TriangleMesh triangles = snapshot.mesh();
  nb::dict mesh = meshOf(triangles, isDouble);
  nb::dict data;
  data["Normals"] = rowsOf<float>(pointNormals(triangles));
  data["Activity"] =
    arrayOf(std::vector<double>(snapshot.activities.begin(), snapshot.activities.end()));
  mesh["point_data"] = data;
  nb::dict fields;
  fields["NumberOfVertices"] = triangles.points.size();
  fields["Iterations"] = snapshot.iterations;
  mesh["field_data"] = fields;
  return mesh;
}

void addSides(const OrientationReport& report, nb::dict& fields)
{
  fields["OrientedBy"] = textOf(name(report.main()));
  fields["UnorientedPieces"] = report.unknownPieces;
  fields["UnorientedShare"] = report.unknownShare();
  fields["GuessedShare"] = report.guessedShare;
}

void addQuality(const Reconstruction& result, double unit, nb::dict& fields)
{
  const SurfaceReport& surface = result.quality->surface;
  fields["Residual"] = result.quality->residual;
  constexpr double NotTold = std::numeric_limits<double>::quiet_NaN();
  fields["Noise"] = result.finish ? result.finish->noise * unit : NotTold;
  fields["SharedNoise"] = result.finish ? result.finish->sharedNoise * unit : NotTold;
  fields["OutlierShare"] = result.quality->outlierShare;
  fields["RegularRatio"] = surface.regularRatio;
  fields["TriangleQuality"] = surface.meanQuality;
  fields["Components"] = surface.components;
  fields["Genus"] = surface.genus.value_or(-1);
  fields["BoundaryLoops"] = surface.boundaryLoops;
  fields["FoldedEdges"] = surface.foldedEdges;
  constexpr std::int64_t NotLookedFor = -1;
  fields["IntersectingTriangles"] =
    result.finish ? std::int64_t(result.finish->left.intersectingTriangles) : NotLookedFor;
  fields["NarrowHandles"] = result.quality->narrowHandles.count;
  fields["FitRoundsTakenBack"] = result.finish ? result.finish->roundsTakenBack : 0;
}

void addCounts(const Explanation& explanation, nb::dict& fields)
{
  fields["OutlierPoints"] = std::llround(explanation.count(Reason::Outlier));
  fields["SmallPiecePoints"] = std::llround(explanation.count(Reason::SmallPiece));
  fields["UnreachablePoints"] = std::llround(explanation.count(Reason::Unreachable));
  fields["UnexplainedPoints"] = std::llround(explanation.unexplained());
  fields["UnexplainedShare"] = explanation.unexplainedShare();
}

void addTuning(const Tuning& tuning, nb::dict& fields)
{
  std::vector<std::string> chosen;
  for (const TuningChoice& choice : tuning.choices)
  {
    chosen.push_back(choice.assignment());
  }
  fields["ChosenParameters"] = chosen;
  fields["ReasonsOfChoice"] = tuning.reasons();
}

void addSize(const SizeChoice& choice, nb::dict& fields)
{
  constexpr double NotTold = std::numeric_limits<double>::quiet_NaN();
  fields["PredictedError"] = choice.predicted;
  fields["ReachedError"] = choice.reached;
  fields["NoiseTakenOff"] = choice.noise;
  fields["ErrorWithHalf"] = choice.expectedWith(choice.vertices / 2).value_or(NotTold);
  fields["ErrorWithTwice"] = choice.expectedWith(2 * choice.vertices).value_or(NotTold);
  fields["Choice"] = choice.reasons();
}

std::vector<std::string> textsOf(const Tuning& tuning)
{
  std::vector<std::string> texts;
  for (const TuningChoice& choice : tuning.choices)
  {
    texts.push_back("has chosen " + choice.assignment());
  }
  const std::vector<std::string> reasons = tuning.reasons();
  texts.insert(texts.end(), reasons.begin(), reasons.end());
  return texts;
}

nb::dict curveOf(const LearningCurve& curve)
{
  using Row = LearningCurve::Row;
  nb::dict columns;
  const auto addCounts = [&](const char* column, const auto& valueOf)
  {
    std::vector<std::int64_t> values;
    for (const Row& row : curve.rows())
    {
      values.push_back(std::int64_t(valueOf(row)));
    }
    columns[column] = arrayOf(std::move(values));
  };
  const auto addNumbers = [&](const char* column, double Row::*number)
  {
    std::vector<double> values;
    for (const Row& row : curve.rows())
    {
      values.push_back(row.*number);
    }
    columns[column] = arrayOf(std::move(values));
  };
  addCounts("Iteration", [](const Row& row) { return row.counts.iterations; });
  addCounts("Vertices", [](const Row& row) { return row.vertices; });
  addNumbers("Seconds", &Row::seconds);
  addNumbers("SampleDistanceMean", &Row::sampleDistanceMean);
  addNumbers("SampleDistanceDeviation", &Row::sampleDistanceDeviation);
  addNumbers("NormalChangeMean", &Row::normalChangeMean);
  addNumbers("RegularRatio", &Row::regularRatio);
  addCounts("Additions", [](const Row& row) { return row.counts.additions; });
  addCounts("Removals", [](const Row& row) { return row.counts.removals; });
  addCounts("Flips", [](const Row& row) { return row.counts.flips; });
  addCounts("RejectedSamples", [](const Row& row) { return row.counts.rejectedSamples; });
  addCounts("IllegalOperations", [](const Row& row) { return row.counts.illegalOperations; });
  addCounts("RemovedTriangles", [](const Row& row) { return row.counts.removedTriangles; });
  addCounts("MergedBoundaries", [](const Row& row) { return row.counts.mergedBoundaries; });
  addCounts("FilledBoundaries", [](const Row& row) { return row.counts.filledBoundaries; });
  return columns;
}

nb::dict explainedOf(
  const Explanation& explanation, const PointCloud& cloud, std::size_t pointCount)
{
  std::vector<double> distances(pointCount, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::uint8_t> reasons(pointCount, std::uint8_t(Reason::Dropped));
  for (const std::uint32_t point : cloud.farPoints())
  {
    reasons[point] = std::uint8_t(Reason::Outlier);
  }
  for (std::size_t i = 0; i < explanation.reasons.size(); ++i)
  {
    const std::uint32_t point = cloud.origins()[explanation.asked.points[i]];
    distances[point] = cloud.unit() * double(explanation.asked.distances[i]);
    reasons[point] = std::uint8_t(explanation.reasons[i]);
  }
  nb::dict fields;
  std::vector<std::string> names;
  for (std::size_t reason = 0; reason < Reasons; ++reason)
  {
    names.push_back(textOf(name(Reason(reason))));
  }
  fields["ReasonNames"] = names;
  std::vector<Eigen::Vector3d> centers;
  std::vector<std::int64_t> counts;
  for (const MissedPiece& piece : explanation.pieces)
  {
    centers.push_back(piece.center);
    counts.push_back(std::llround(piece.points));
  }
  fields["MissedPieceCenters"] = rowsOf<double>(centers);
  fields["MissedPiecePoints"] = arrayOf(std::move(counts));
  addCounts(explanation, fields);
  nb::dict result;
  result["Distance"] = arrayOf(std::move(distances));
  result["Reason"] = arrayOf(std::move(reasons));
  result["field_data"] = fields;
  return result;
}

nb::dict linesOf(const FeatureLines& lines, bool isDouble)
{
  std::vector<std::int64_t> corners, linePoints, lineEnds;
  std::vector<double> angles, lengths;
  std::vector<std::int32_t> chains;
  std::vector<std::uint8_t> isCorner(lines.points.size());
  const auto addData = [&](double angle, std::size_t chain, double length)
  {
    angles.push_back(angle);
    chains.push_back(std::int32_t(chain));
    lengths.push_back(length);
  };
  for (const FeatureLines::Corner& corner : lines.corners)
  {
    corners.push_back(corner.point);
    isCorner[corner.point] = 1;
    addData(corner.angle, corner.chain, 0.);
  }
  for (const FeatureLine& line : lines.lines)
  {
    linePoints.insert(linePoints.end(), line.points.begin(), line.points.end());
    lineEnds.push_back(std::int64_t(linePoints.size()));
    addData(line.angle, line.chain, line.length);
  }
  nb::dict pointData, cellData, result;
  pointData["Corner"] = arrayOf(std::move(isCorner));
  pointData["Vertex"] =
    arrayOf(std::vector<std::int32_t>(lines.vertices.begin(), lines.vertices.end()));
  cellData["Angle"] = arrayOf(std::move(angles));
  cellData["Chain"] = arrayOf(std::move(chains));
  cellData["Length"] = arrayOf(std::move(lengths));
  result["points"] = isDouble ? rowsOf<double>(lines.points) : rowsOf<float>(lines.points);
  result["corners"] = arrayOf(std::move(corners));
  result["line_points"] = arrayOf(std::move(linePoints));
  result["line_ends"] = arrayOf(std::move(lineEnds));
  result["point_data"] = pointData;
  result["cell_data"] = cellData;
  result["creases"] = arrayOf(lines.creases);
  return result;
}
}
