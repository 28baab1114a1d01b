// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/OrientationVote.h"

#include "base/Median.h"
#include "cloud/MeshBuilder.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/Visibility.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace neuralmesh
{
namespace
{
/// The part of all votes by which one side must be ahead of the other.
constexpr double LeastLead = 0.2;
/// ... and of what the votes would be if all directions were normals: three degrees.
constexpr double LeastSlant = 0.05;
/// ... and by how many standard deviations, where votes may be at random.
constexpr double LeastDeviations = 3.;

constexpr std::size_t VotesPerVertex = 2;
constexpr std::size_t LinesOfSight = 16384;
/// A part for the executor.
constexpr std::size_t VotesPerRange = 1024;
constexpr std::size_t LinesPerRange = 256;

/// The unit vector, or 0 if there is none.
Eigen::Vector3d directionOf(const Eigen::Vector3d& vector)
{
  const double length = vector.stableNorm();
  return length > 0. && std::isfinite(length) ? Eigen::Vector3d(vector / length)
                                              : Eigen::Vector3d::Zero();
}
}

struct OrientationVote::Ballot
{
  double lead = 0.;
  double votes = 0.;
  double squares = 0.;
  double most = 0.;

  /// A vote is a cosine times `weight`.
  void add(double vote, double weight)
  {
    lead += vote;
    votes += std::abs(vote);
    squares += vote * vote;
    most += weight;
  }

  Side side(SideEvidence evidence, double leastDeviations) const
  {
    const double least =
      std::max({ LeastLead * votes, LeastSlant * most, leastDeviations * std::sqrt(squares) });
    return votes > 0. && std::abs(lead) >= least ? Side{ evidence, lead < 0. } : Side{};
  }

  static std::vector<Side> sidesOf(
    const std::vector<Ballot>& ballots, SideEvidence evidence, double leastDeviations = 0.)
  {
    std::vector<Side> sides;
    sides.reserve(ballots.size());
    for (const Ballot& ballot : ballots)
    {
      sides.push_back(ballot.side(evidence, leastDeviations));
    }
    return sides;
  }
};

OrientationVote::OrientationVote(const Mesh& mesh, std::span<const Piece> pieces,
  const PointCloud& cloud, const OrientationHints& hints, const Executor& executor)
  : mesh_(mesh)
  , pieces_(pieces)
  , cloud_(cloud)
  , hints_(hints)
  , executor_(executor)
{
}

VotedSides OrientationVote::byViewpoints() const
{
  if (!hints_.viewOf)
  {
    return countLinesOfSight();
  }
  const auto directionTo = [this](std::size_t point)
  {
    const std::uint32_t view = hints_.viewOf(cloud_.origins()[point]);
    return view < hints_.viewpoints.size()
      ? Eigen::Vector3d(hints_.viewpoints[view] - cloud_.toInput(cloud_.points()[point]))
      : Eigen::Vector3d::Zero();
  };
  return countPoints(directionTo, SideEvidence::Viewpoints);
}

VotedSides OrientationVote::byNormals() const
{
  const auto directionOfNormal = [this](std::size_t point)
  { return hints_.normalOf(cloud_.origins()[point]); };
  return countPoints(directionOfNormal, SideEvidence::Normals, LeastDeviations);
}

std::vector<Side> OrientationVote::byUpDirection() const
{
  const Eigen::Vector3d up = directionOf(*hints_.up);
  const std::vector<std::uint32_t> pieceOf = pieceOfVertices();
  std::vector<Ballot> ballots(pieces_.size());
  mesh_.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Eigen::Vector3d normal = normalOf({ a, b, c });
      ballots[pieceOf[a]].add(normal.dot(up), normal.norm());
    });
  return Ballot::sidesOf(ballots, SideEvidence::UpDirection);
}

/// By every so many of the points that are near the mesh.
VotedSides OrientationVote::countPoints(
  const DirectionOf& directionOfPoint, SideEvidence evidence, double leastDeviations) const
{
  struct Vote
  {
    VertexIndex vertex;
    float vote;
    float weight;
  };
  const std::size_t points = cloud_.points().size();
  // Odd, for of points that lie in pairs one may know more than the other.
  const std::size_t stride = (points / (VotesPerVertex * mesh_.indexEnd())) | 1;
  const std::size_t count = (points + stride - 1) / stride;
  const VertexGrid grid = gridOf(mesh_, cloud_);
  std::vector<Vote> votes(count);
  std::vector<float> squaredDistances(count);
  executor_.forEachRange(count, VotesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t point = i * stride;
        const PlaceOnMesh place = closestPlace(cloud_.points()[point], mesh_, grid);
        const Eigen::Vector3d direction = directionOf(directionOfPoint(point));
        const double cosine = directionOf(normalOf(place.triangle)).dot(direction);
        const float weight = direction.isZero(0.) ? 0.f : cloud_.weight(point);
        votes[i] = { place.triangle[0], weight * float(cosine), weight };
        squaredDistances[i] = place.squaredDistance;
      }
    });
  const float farthest =
    outlierDistance(std::sqrt(medianOf(squaredDistances, executor_)), mesh_.meanEdge());
  const std::vector<std::uint32_t> pieceOf = pieceOfVertices();
  std::vector<Ballot> ballots(pieces_.size());
  std::vector<float> votesOfVertices(mesh_.indexEnd(), 0.f);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (squaredDistances[i] <= farthest * farthest)
    {
      const auto& [vertex, vote, weight] = votes[i];
      ballots[pieceOf[vertex]].add(double(vote), double(weight));
      votesOfVertices[vertex] += vote;
    }
  }
  return { Ballot::sidesOf(ballots, evidence, leastDeviations), std::move(votesOfVertices) };
}

/// By triangles with nothing between them and a viewpoint.
VotedSides OrientationVote::countLinesOfSight() const
{
  const TriangleMesh surface = trianglesOf(mesh_, cloud_, executor_);
  const Visibility visibility(surface);
  const std::size_t viewpoints = hints_.viewpoints.size();
  const std::size_t all = surface.triangles.size() * viewpoints;
  // The lines that are looked along are spread over triangles and viewpoints.
  const std::size_t stride = 1 + all / std::max(LinesOfSight, surface.points.size() / 2);
  const std::size_t count = (all + stride - 1) / stride;
  std::vector<double> votes(count, 0.), weights(count, 0.);
  executor_.forEachRange(count, LinesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        // From one line to the next the viewpoint changes, whatever the stride, so that none is left out.
        const auto& [a, b, c] = surface.triangles[i * stride / viewpoints];
        const Eigen::Vector3d& viewpoint = hints_.viewpoints[i % viewpoints];
        const Eigen::Vector3d place =
          (surface.points[a] + surface.points[b] + surface.points[c]) / 3.;
        const Eigen::Vector3d direction = directionOf(viewpoint - place);
        if (!direction.isZero(0.) && visibility.isSeen(place, viewpoint))
        {
          const Eigen::Vector3d normal = normalOf({ a, b, c });
          votes[i] = normal.dot(direction);
          weights[i] = normal.norm();
        }
      }
    });
  const std::vector<std::uint32_t> pieceOf = pieceOfVertices();
  std::vector<Ballot> ballots(pieces_.size());
  for (std::size_t i = 0; i < count; ++i)
  {
    ballots[pieceOf[surface.triangles[i * stride / viewpoints][0]]].add(votes[i], weights[i]);
  }
  return { Ballot::sidesOf(ballots, SideEvidence::Viewpoints), {} };
}

std::vector<std::uint32_t> OrientationVote::pieceOfVertices() const
{
  std::vector<std::uint32_t> pieceOf(mesh_.indexEnd());
  for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece)
  {
    for (const VertexIndex v : pieces_[piece].vertices)
    {
      pieceOf[v] = piece;
    }
  }
  return pieceOf;
}

/// As long as twice the area.
Eigen::Vector3d OrientationVote::normalOf(const Triangle& triangle) const
{
  const Eigen::Vector3d a = mesh_.position(triangle[0]).toDouble();
  return (mesh_.position(triangle[1]).toDouble() - a)
    .cross(mesh_.position(triangle[2]).toDouble() - a);
}
}
