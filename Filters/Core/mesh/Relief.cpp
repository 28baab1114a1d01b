// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Relief.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

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

Side sideByRelief(const Mesh& mesh, const Piece& piece)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  forEachTriangleOf(mesh, piece,
    [&](VertexIndex a, VertexIndex b, VertexIndex c) { sum += areaVector(mesh, a, b, c); });
  const Eigen::Vector3d up = sum.normalized();
  std::vector<Facet> facets;
  forEachTriangleOf(mesh, piece,
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const Eigen::Vector3d area = areaVector(mesh, a, b, c);
      const Eigen::Vector3d centroid =
        (mesh.position(a).toDouble() + mesh.position(b).toDouble() + mesh.position(c).toDouble()) /
        3.;
      facets.push_back({ centroid.dot(up), area.dot(up), area.norm() });
    });
  const double bottom = heightOfGround(facets);
  const double thickness = ThicknessOfGround * std::sqrt(piece.area);
  double ground = 0., above = 0., below = 0.;
  for (const Facet& facet : facets)
  {
    const double height = facet.height - bottom;
    ground += facet.isLevel() && std::abs(height) <= thickness ? facet.area : 0.;
    above += height > thickness ? height * facet.level : 0.;
    below -= height < -thickness ? height * facet.level : 0.;
  }
  const double most = std::max(std::abs(above), std::abs(below));
  const double least = std::min(std::abs(above), std::abs(below));
  const bool tells = ground >= LeastGroundOfPiece * piece.area &&
    most >= LeastRatioOfReliefs * least && most >= LeastRelief * std::pow(ground, 1.5);
  return tells ? Side{ SideEvidence::Volume, std::abs(below) > std::abs(above), true } : Side{};
}
}

std::vector<Side> sidesByRelief(
  const Mesh& mesh, std::span<const Piece> pieces, std::span<const Side> known)
{
  std::vector<Side> sides(pieces.size());
  std::transform(pieces.begin(), pieces.end(), known.begin(), sides.begin(),
    [&](const Piece& piece, const Side& side)
    { return side.isKnown() ? Side() : sideByRelief(mesh, piece); });
  return sides;
}
}
