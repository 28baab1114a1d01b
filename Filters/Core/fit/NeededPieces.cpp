// SPDX-License-Identifier: BSD-3-Clause
#include "fit/NeededPieces.h"

#include "base/Median.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/VertexGrid.h"
#include "fit/HeldOutPoints.h"
#include "fit/PointSpacing.h"
#include "mesh/NearestTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr std::size_t MostAskedOfPieces = 200'000;
constexpr std::size_t AskedOfPiecesPerRange = 512;
constexpr std::size_t AskedForNoise = 5000;
constexpr std::uint32_t OfNoPiece = 0xffffffffu;
/// A point is missed beyond so many of its distances to its neighbours, and so many median distances to the mesh.
constexpr float MissedByPieceSpacings = 3.f;
constexpr float MissedByPieceMedians = 8.f;
/// Fewer lie together by chance.
constexpr double FewestNeeding = 24.;

/// What is left of a mesh without some pieces.
TriangleMesh remainder(const Mesh& mesh, const std::vector<std::uint32_t>& pieceOf)
{
  TriangleMesh result = trianglesIn(mesh);
  std::erase_if(
    result.triangles, [&](const auto& triangle) { return pieceOf[triangle[0]] != OfNoPiece; });
  return result;
}
}

std::vector<Piece> withoutNeeded(std::vector<Piece> pieces, const Mesh& mesh,
  const PointCloud& cloud, double part, const Executor& executor)
{
  if (pieces.empty())
  {
    return pieces;
  }
  std::vector<std::uint32_t> pieceOf(mesh.indexEnd(), OfNoPiece);
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (const VertexIndex v : pieces[i].vertices)
    {
      pieceOf[v] = std::uint32_t(i);
    }
  }
  const std::size_t all = cloud.points().size(), asked = std::min(all, MostAskedOfPieces);
  const VertexGrid grid = gridOf(mesh, cloud, executor);
  const auto pointAsked = [&](std::size_t i) { return cloud.points()[i * all / asked]; };
  std::vector<std::uint32_t> nearTo(asked);
  executor.forEachRange(asked, AskedOfPiecesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        nearTo[i] = pieceOf[grid.closest(pointAsked(i), mesh.positions())];
      }
    });
  const double least = std::max(part * double(asked), FewestNeeding);
  std::vector<double> near(pieces.size(), 0.), missed = near;
  for (const std::uint32_t piece : nearTo)
  {
    if (piece != OfNoPiece)
    {
      near[piece] += 1.;
    }
  }
  if (*std::max_element(near.begin(), near.end()) < least)
  {
    return pieces;
  }
  const float noise = std::sqrt(medianOf(squaredDistances(
    cloud, heldOutPoints(cloud, AskedForNoise), mesh, executor, DistanceTo::Surface)));
  const NearestTriangle others(remainder(mesh, pieceOf), executor);
  const PointSpacing spacing(cloud, executor);
  for (std::size_t i = 0; i < asked; ++i)
  {
    if (nearTo[i] != OfNoPiece && near[nearTo[i]] >= least)
    {
      const Vector4 point = pointAsked(i);
      const double limit =
        double(std::max(MissedByPieceMedians * noise, MissedByPieceSpacings * spacing.at(point)));
      missed[nearTo[i]] +=
        others.find(point.toDouble(), limit * limit).triangle == NearestTriangle::None ? 1. : 0.;
    }
  }
  std::vector<Piece> result;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (missed[i] < least)
    {
      result.push_back(std::move(pieces[i]));
    }
  }
  return result;
}
}
