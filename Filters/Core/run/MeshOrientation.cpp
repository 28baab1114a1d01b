// SPDX-License-Identifier: BSD-3-Clause
#include "run/MeshOrientation.h"

#include "cloud/OrientationVote.h"
#include "cloud/PieceAgreement.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// Fills in what is not known yet. Returns whether `more` has told nothing.
bool addSides(const std::vector<Side>& more, std::vector<Side>& sides)
{
  std::transform(sides.begin(), sides.end(), more.begin(), sides.begin(),
    [](const Side& known, const Side& other) { return known.isKnown() ? known : other; });
  return std::none_of(more.begin(), more.end(), [](const Side& side) { return side.isKnown(); });
}
}

OrientationReport orientMesh(
  Mesh& mesh, const PointCloud& cloud, const OrientationHints& hints, const Executor& executor)
{
  const std::vector<Piece> pieces = findPieces(mesh);
  const OrientationVote vote(mesh, pieces, cloud, hints, executor);
  std::vector<Side> sides(pieces.size()), byVolume(pieces.size());
  const bool areViewpointsMute = !hints.viewpoints.empty() && addSides(vote.byViewpoints(), sides);
  const bool isUpMute = hints.up && addSides(vote.byUpDirection(), sides);
  const bool areNormalsMute = hints.normalOf && addSides(vote.byNormals(), sides);
  std::transform(pieces.begin(), pieces.end(), byVolume.begin(), sideByVolume);
  addSides(byVolume, sides);
  makePiecesAgree(mesh, pieces, sides);
  OrientationReport report = turn(mesh, pieces, sides);
  report.toldNothing[std::size_t(SideEvidence::Viewpoints)] = areViewpointsMute;
  report.toldNothing[std::size_t(SideEvidence::UpDirection)] = isUpMute;
  report.toldNothing[std::size_t(SideEvidence::Normals)] = areNormalsMute;
  return report;
}
}
