// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Relief.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// Of the angle between what is level and the sum of the normals.
constexpr double CosineOfLevel = 0.95;
/// Of the area of the piece.
constexpr double LeastGroundOfPiece = 0.33;
/// What is no farther above or below it is the ground, in roots of the area of the piece.
constexpr double ThicknessOfGround = 0.02;
/// The relief of one side is so much more than that of the other.
constexpr double LeastRatioOfReliefs = 4.;
/// The volume of the relief, of the area of the ground to the power of 1.5.
constexpr double LeastRelief = 1. / 500.;
/// The area of what stands on a ground without being connected to it, of that of the ground.
constexpr double LeastStanding = 0.02;
/// The area of such a ground, of that of all pieces. So there are few of them, however many pieces there are.
constexpr double LeastGroundOfAll = 0.1;

/// One triangle, in the direction of the sum of the normals.
struct Facet
{
  double height = 0.; ///< of the centroid
  double level = 0.;  ///< the area times the cosine of its angle to what is level
  double area = 0.;

  bool isLevel() const { return std::abs(level) > CosineOfLevel * area; }
};

Eigen::Vector3d areaVector(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c)
{
  return (0.5f * cross(mesh.position(b) - mesh.position(a), mesh.position(c) - mesh.position(a)))
    .toDouble();
}

template <typename Use>
void forEachTriangleOf(const Mesh& mesh, const Piece& piece, const Use& use)
{
  for (const VertexIndex v : piece.vertices)
  {
    mesh.forEachTriangleFrom(v, use);
  }
}

/// Half of the level area lies below.
double heightOfGround(std::vector<Facet> facets)
{
  std::erase_if(facets, [](const Facet& facet) { return !facet.isLevel(); });
  std::sort(facets.begin(), facets.end(),
    [](const Facet& a, const Facet& b) { return a.height < b.height; });
  double half = 0.;
  for (const Facet& facet : facets)
  {
    half += facet.area / 2.;
  }
  for (const Facet& facet : facets)
  {
    half -= facet.area;
    if (half <= 0.)
    {
      return facet.height;
    }
  }
  return 0.;
}

Eigen::Vector3d centroidOf(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c)
{
  return (mesh.position(a).toDouble() + mesh.position(b).toDouble() + mesh.position(c).toDouble()) /
    3.;
}

/// The level part of a piece, in the direction of the sum of the normals.
struct Ground
{
  Ground(const Mesh& mesh, const Piece& piece)
    : thickness(ThicknessOfGround * std::sqrt(piece.area))
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    forEachTriangleOf(mesh, piece,
      [&](VertexIndex a, VertexIndex b, VertexIndex c) { sum += areaVector(mesh, a, b, c); });
    up = sum.normalized();
    forEachTriangleOf(mesh, piece,
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const Eigen::Vector3d vector = areaVector(mesh, a, b, c);
        facets.push_back({ centroidOf(mesh, a, b, c).dot(up), vector.dot(up), vector.norm() });
      });
    height = heightOfGround(facets);
    for (Facet& facet : facets)
    {
      facet.height -= height;
      area += facet.isLevel() && std::abs(facet.height) <= thickness ? facet.area : 0.;
    }
    isGround = area >= LeastGroundOfPiece * piece.area;
  }

  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  double height = 0.; ///< along `up`
  double thickness;   ///< what is no farther above or below belongs to it
  double area = 0.;
  bool isGround = false;     ///< whether it is large enough
  std::vector<Facet> facets; ///< of the piece; their heights are above the ground
};

Side sideByRelief(const Mesh& mesh, const Piece& piece)
{
  const Ground ground(mesh, piece);
  double above = 0., below = 0.;
  for (const auto& [height, level, area] : ground.facets)
  {
    above += height > ground.thickness ? height * level : 0.;
    below -= height < -ground.thickness ? height * level : 0.;
  }
  const double most = std::max(std::abs(above), std::abs(below));
  const double least = std::min(std::abs(above), std::abs(below));
  const bool tells = ground.isGround && most >= LeastRatioOfReliefs * least &&
    most >= LeastRelief * std::pow(ground.area, 1.5);
  return tells ? Side{ SideEvidence::Volume, std::abs(below) > std::abs(above), true } : Side{};
}

Side sideByStanding(const Mesh& mesh, std::span<const Piece> pieces, const Piece& piece)
{
  const Ground ground(mesh, piece);
  double above = 0., below = 0.;
  for (const Piece& other : pieces)
  {
    if (!ground.isGround || other.area >= piece.area)
    {
      continue;
    }
    forEachTriangleOf(mesh, other,
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        const double height = centroidOf(mesh, a, b, c).dot(ground.up) - ground.height;
        const double area = areaVector(mesh, a, b, c).norm();
        above += height > ground.thickness ? area : 0.;
        below += height < -ground.thickness ? area : 0.;
      });
  }
  const double most = std::max(above, below), least = std::min(above, below);
  const bool tells =
    ground.isGround && most >= LeastRatioOfReliefs * least && most >= LeastStanding * ground.area;
  return tells ? Side{ SideEvidence::Volume, below > above, true } : Side{};
}

/// Of the pieces whose side is not known.
template <typename SideOf>
std::vector<Side> sidesOfUnknown(
  std::span<const Piece> pieces, std::span<const Side> known, const SideOf& sideOf)
{
  std::vector<Side> sides(pieces.size());
  std::transform(pieces.begin(), pieces.end(), known.begin(), sides.begin(),
    [&](const Piece& piece, const Side& side) { return side.isKnown() ? Side() : sideOf(piece); });
  return sides;
}
}

std::vector<Side> sidesByRelief(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> known)
{
  return sidesOfUnknown(
    pieces, known, [&](const Piece& piece) { return sideByRelief(mesh, piece); });
}

std::vector<Side> sidesByStanding(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> known)
{
  const double all = std::accumulate(pieces.begin(), pieces.end(), 0.,
    [](double sum, const Piece& piece) { return sum + piece.area; });
  return sidesOfUnknown(pieces, known,
    [&](const Piece& piece)
    { return piece.area < LeastGroundOfAll * all ? Side() : sideByStanding(mesh, pieces, piece); });
}
}
