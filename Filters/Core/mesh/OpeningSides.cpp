// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OpeningSides.h"

#include "mesh/BoundaryManager.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Of all directions, from the vertices of a piece in an opening.
constexpr double LeastPartSeen = 0.25;
/// The mean cosine between the field and the normals of the piece.
constexpr double LeastCosine = 0.5;
/// From farther off than this, in radii of the opening around its centroid, it is not seen so wide.
constexpr double FarthestOff = 2.;
/// Vertices that are looked at: of all pieces, and of each.
constexpr std::size_t VerticesOfAll = 1000;
constexpr std::size_t LeastVerticesOfPiece = 4;

/// A loop, run through so that a surface that closes it would look outwards.
class Opening
{
public:
  explicit Opening(std::vector<Eigen::Vector3d> corners)
    : corners_(std::move(corners))
  {
    for (const Eigen::Vector3d& corner : corners_)
    {
      center_ += corner / double(corners_.size());
    }
    for (const Eigen::Vector3d& corner : corners_)
    {
      radius_ = std::max(radius_, (corner - center_).norm());
    }
  }

  bool isNear(const Eigen::Vector3d& place) const
  {
    return (place - center_).norm() < FarthestOff * radius_;
  }

  /// Of all directions, closed by a fan of triangles to its centroid.
  double partSeen(const Eigen::Vector3d& place) const
  {
    double angle = 0.;
    forEachEdge(
      [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      {
        const Eigen::Vector3d a = from - place, b = to - place, c = center_ - place;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        angle += 2. *
          std::atan2(
            a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
      });
    return std::abs(angle) / (4. * std::numbers::pi);
  }

  Eigen::Vector3d field(const Eigen::Vector3d& place) const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    forEachEdge(
      [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to)
      {
        const Eigen::Vector3d away = place - (from + to) / 2.;
        const double distance = away.norm();
        if (distance > 0.)
        {
          sum += (to - from).cross(away) / (distance * distance * distance);
        }
      });
    return sum;
  }

private:
  template <typename Use>
  void forEachEdge(Use use) const
  {
    for (std::size_t i = 0; i < corners_.size(); ++i)
    {
      use(corners_[i], corners_[(i + 1) % corners_.size()]);
    }
  }

  std::vector<Eigen::Vector3d> corners_;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  double radius_ = 0.;
};

std::vector<Opening> openingsOf(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides)
{
  std::vector<const Side*> sideOf(mesh.indexEnd());
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      sideOf[v] = &sides[i];
    }
  }
  const BoundaryManager boundaries(mesh);
  std::vector<Opening> openings;
  for (BoundaryManager::LoopIndex loop = 0; loop < boundaries.loops().size(); ++loop)
  {
    const std::vector<VertexIndex> vertices = boundaries.vertices(mesh, loop);
    const Side& side = *sideOf[vertices.front()];
    if (side.isKnown())
    {
      std::vector<Eigen::Vector3d> corners(vertices.size());
      std::transform(vertices.begin(), vertices.end(), corners.begin(),
        [&mesh](VertexIndex v) { return mesh.position(v).toDouble(); });
      if (side.isTurned)
      {
        std::reverse(corners.begin(), corners.end());
      }
      openings.emplace_back(std::move(corners));
    }
  }
  return openings;
}

/// What a piece in an opening sees of it.
struct Sight
{
  double part = 0.;   ///< of all directions
  double cosine = 0.; ///< between the field and the normals of the piece
};

/// From so many vertices of a piece.
Sight sightOf(const Opening& opening, const Mesh& mesh, const Piece& piece, std::size_t count)
{
  const std::size_t step = std::max<std::size_t>(1, piece.vertices.size() / count);
  Sight sum;
  double looked = 0.;
  for (std::size_t i = step / 2; i < piece.vertices.size(); i += step)
  {
    const Eigen::Vector3d place = mesh.position(piece.vertices[i]).toDouble();
    ++looked;
    if (opening.isNear(place))
    {
      const Eigen::Vector3d normal = mesh.normal(piece.vertices[i]).toDouble().normalized();
      sum.part += opening.partSeen(place);
      sum.cosine += opening.field(place).normalized().dot(normal);
    }
  }
  return { sum.part / looked, sum.cosine / looked };
}

/// By the opening that is seen the widest.
Side sideIn(
  std::span<const Opening> openings, const Mesh& mesh, const Piece& piece, std::size_t count)
{
  Sight widest;
  for (const Opening& opening : openings)
  {
    const Sight sight = sightOf(opening, mesh, piece, count);
    widest = sight.part > widest.part ? sight : widest;
  }
  const bool tells = widest.part >= LeastPartSeen && std::abs(widest.cosine) >= LeastCosine;
  return tells ? Side{ SideEvidence::Neighbors, widest.cosine < 0. } : Side{};
}
}

std::vector<Side> sidesByOpenings(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> sides)
{
  std::vector<Side> result(pieces.size());
  const auto unknown = std::size_t(
    std::count_if(sides.begin(), sides.end(), [](const Side& side) { return !side.isKnown(); }));
  if (unknown == 0 || unknown == pieces.size())
  {
    return result;
  }
  const std::vector<Opening> openings = openingsOf(mesh, pieces, sides);
  const std::size_t count = std::max(LeastVerticesOfPiece, VerticesOfAll / unknown);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (!sides[i].isKnown())
    {
      result[i] = sideIn(openings, mesh, pieces[i], count);
    }
  }
  return result;
}
}
