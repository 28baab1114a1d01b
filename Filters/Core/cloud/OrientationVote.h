// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/OrientationHints.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "mesh/Orientation.h"

#include <functional>
#include <span>
#include <vector>

namespace neuralmesh
{
/// What directions of one kind tell.
struct VotedSides
{
  /// Of each piece.
  std::vector<Side> sides;
  /// Of each vertex the sum of its votes, negative where they are against its normal. None of lines of sight: through
  /// openings, these see the inside of what is right.
  std::vector<float> votes;
};

/// Has each piece of a mesh voted on by directions in which it should look. A vote is the cosine of the
/// angle between such a direction and the normal of the triangle. A piece has a side if one side has at
/// least three votes where the other has two, and the surface is inclined by three degrees to it on
/// average.
class OrientationVote
{
public:
  /// No vertex may be erased. All must outlive the vote; the cloud must know the origins of its points
  /// where the hints need them.
  OrientationVote(const Mesh& mesh, std::span<const Piece> pieces, const PointCloud& cloud,
    const OrientationHints& hints, const Executor& executor = Executor::sequential());

  /// By the viewpoints of points near the pieces, or from which the pieces are seen. Up to 2 points a
  /// vertex vote, or 16384 lines of sight are looked along, or one for two vertices if that is more.
  VotedSides byViewpoints() const;
  /// By the normals of points near the pieces, 2 a vertex at most. One side must have more votes than
  /// normals that point anywhere would give it once in 400 pieces.
  VotedSides byNormals() const;
  /// By area: a closed piece looks upwards as much as downwards.
  std::vector<Side> byUpDirection() const;

private:
  struct Ballot;
  /// The direction of a point of the cloud.
  using DirectionOf = std::function<Eigen::Vector3d(std::size_t)>;

  VotedSides countPoints(
    const DirectionOf& directionOf, SideEvidence evidence, double leastDeviations = 0.) const;
  VotedSides countLinesOfSight() const;
  std::vector<std::uint32_t> pieceOfVertices() const;
  Eigen::Vector3d normalOf(const Triangle& triangle) const;

  const Mesh& mesh_;
  std::span<const Piece> pieces_;
  const PointCloud& cloud_;
  const OrientationHints& hints_;
  const Executor& executor_;
};
}
