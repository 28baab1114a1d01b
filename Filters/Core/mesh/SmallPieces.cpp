// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SmallPieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace neuralmesh
{
namespace
{
constexpr double LeastPart = 0.02;
/// Of the area: a piece with less is small, if it is one of a few. Where more than half of the vertices are
/// in such pieces, it is the others that are odd.
constexpr double PartOfSmallPiece = 0.01;
constexpr double MostOfVertices = 0.5;

/// A fan or strip of three triangles has five.
constexpr std::size_t MostVerticesOfScrap = 5;
/// From the vertices of what it lies on.
constexpr double EdgesToScrap = 1.5;

struct Scrap
{
  const Piece* piece;
  Vector4 place;
  bool isNearOther = false;
};

/// Finds the scraps within some reach of a place, by cubes as wide as that: O(log n) for n scraps.
class ScrapSearch
{
public:
  ScrapSearch(std::vector<Scrap>& scraps, float reach)
    : scraps_(scraps)
    , reach_(reach)
  {
    for (std::size_t i = 0; i < scraps.size(); ++i)
    {
      const Cube cube = cubeOf(scraps[i].place);
      for (const double x : { -1., 0., 1. })
      {
        for (const double y : { -1., 0., 1. })
        {
          for (const double z : { -1., 0., 1. })
          {
            byCube_.emplace(Cube{ cube[0] + x, cube[1] + y, cube[2] + z }, i);
          }
        }
      }
    }
  }

  /// What lies near the place does so near another piece.
  void markAround(Vector4 place)
  {
    const auto [begin, end] = byCube_.equal_range(cubeOf(place));
    for (auto at = begin; at != end; ++at)
    {
      Scrap& scrap = scraps_[at->second];
      scrap.isNearOther = scrap.isNearOther || squaredNorm(scrap.place - place) <= reach_ * reach_;
    }
  }

private:
  using Cube = std::array<double, 3>;

  Cube cubeOf(Vector4 place) const
  {
    return { std::floor(double(place[0]) / double(reach_)),
      std::floor(double(place[1]) / double(reach_)),
      std::floor(double(place[2]) / double(reach_)) };
  }

  std::vector<Scrap>& scraps_;
  float reach_;
  std::multimap<Cube, std::size_t> byCube_;
};

/// Those of whole pieces, with their triangles.
void removeVertices(Mesh& mesh, const std::vector<std::uint8_t>& isRemoved)
{
  std::vector<Triangle> triangles;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      if (isRemoved[a] != 0)
      {
        triangles.push_back({ a, b, c });
      }
    });
  mesh.removeTriangles(triangles);
  mesh.dropErased();
}

/// If not all, those with a vertex at the cut.
std::vector<Triangle> findPiecesAtCut(
  const Mesh& mesh, bool areAll, std::span<const std::uint8_t> valencesBefore)
{
  std::vector<std::uint32_t> pieceOf(mesh.indexEnd(), 0);
  std::vector<std::size_t> sizes{ 0 };
  std::vector<bool> isAtCut{ false };
  std::vector<VertexIndex> open;
  for (VertexIndex first = 0; first < mesh.indexEnd(); ++first)
  {
    if (!mesh.isAlive(first) || pieceOf[first] != 0)
    {
      continue;
    }
    const auto piece = std::uint32_t(sizes.size());
    sizes.push_back(0);
    isAtCut.push_back(areAll);
    open.assign(1, first);
    pieceOf[first] = piece;
    while (!open.empty())
    {
      const VertexIndex v = open.back();
      open.pop_back();
      ++sizes[piece];
      if (!isAtCut[piece])
      {
        isAtCut[piece] = v >= valencesBefore.size() || valencesBefore[v] != mesh.valence(v);
      }
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        if (pieceOf[neighbor] == 0)
        {
          pieceOf[neighbor] = piece;
          open.push_back(neighbor);
        }
      }
    }
  }
  const auto largest = double(*std::max_element(sizes.begin(), sizes.end()));
  std::vector<Triangle> result;
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      if (isAtCut[pieceOf[a]] && double(sizes[pieceOf[a]]) < LeastPart * largest)
      {
        result.push_back({ a, b, c });
      }
    });
  return result;
}
}

std::vector<Triangle> findSmallPieces(const Mesh& mesh) { return findPiecesAtCut(mesh, true, {}); }

std::vector<Triangle> findCutOffPieces(
  const Mesh& mesh, std::span<const std::uint8_t> valencesBefore)
{
  return findPiecesAtCut(mesh, false, valencesBefore);
}

std::vector<std::uint8_t> valencesOf(const Mesh& mesh)
{
  std::vector<std::uint8_t> valences(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    valences[v] = std::uint8_t(mesh.valence(v));
  }
  return valences;
}

std::vector<Piece> findOddPieces(
  const Mesh& mesh, double leastArea, double leastVertices, const Executor& executor)
{
  std::vector<Piece> result;
  if (pieceCount(mesh, executor) < 2)
  {
    return result;
  }
  std::vector<Piece> pieces = findPieces(mesh);
  double all = 0., largest = 0.;
  for (const Piece& piece : pieces)
  {
    all += piece.area;
    largest = std::max(largest, piece.area);
  }
  std::size_t vertices = 0;
  for (Piece& piece : pieces)
  {
    if (piece.area < leastArea * all && piece.area < largest &&
      double(piece.vertices.size()) < leastVertices * double(mesh.vertexCount()))
    {
      vertices += piece.vertices.size();
      result.push_back(std::move(piece));
    }
  }
  const bool areSmall = leastArea < PartOfSmallPiece;
  const bool areMost = double(vertices) > MostOfVertices * double(mesh.vertexCount());
  if (areSmall && areMost)
  {
    result.clear();
  }
  return result;
}

void dropPieces(Mesh& mesh, const std::vector<Piece>& pieces)
{
  if (pieces.empty())
  {
    return;
  }
  std::vector<std::uint8_t> isDropped(mesh.indexEnd(), 0);
  for (const Piece& piece : pieces)
  {
    for (const VertexIndex v : piece.vertices)
    {
      isDropped[v] = 1;
    }
  }
  removeVertices(mesh, isDropped);
}

std::size_t dropPieces(Mesh& mesh, double leastArea, double leastVertices, const Executor& executor)
{
  const std::vector<Piece> pieces = findOddPieces(mesh, leastArea, leastVertices, executor);
  dropPieces(mesh, pieces);
  return pieces.size();
}

std::size_t dropScraps(Mesh& mesh, const Executor& executor)
{
  if (pieceCount(mesh, executor) < 2)
  {
    return 0;
  }
  const std::vector<Piece> pieces = findPieces(mesh, executor);
  const auto isSmall = [](const Piece& piece)
  { return !piece.isClosed && piece.vertices.size() <= MostVerticesOfScrap; };
  std::vector<Scrap> scraps;
  for (const Piece& piece : pieces)
  {
    if (isSmall(piece))
    {
      scraps.push_back({ &piece, mesh.position(piece.vertices.front()) });
    }
  }
  const auto reach = float(EdgesToScrap * mesh.meanEdge(executor));
  if (scraps.empty() || !(reach > 0.f))
  {
    return 0;
  }
  ScrapSearch search(scraps, reach);
  for (const Piece& piece : pieces)
  {
    for (std::size_t i = 0; i < piece.vertices.size() && !isSmall(piece); ++i)
    {
      search.markAround(mesh.position(piece.vertices[i]));
    }
  }
  std::vector<std::uint8_t> isScrap(mesh.indexEnd(), 0);
  std::size_t dropped = 0;
  for (const Scrap& scrap : scraps)
  {
    if (scrap.isNearOther)
    {
      ++dropped;
      for (const VertexIndex v : scrap.piece->vertices)
      {
        isScrap[v] = 1;
      }
    }
  }
  if (dropped > 0)
  {
    removeVertices(mesh, isScrap);
  }
  return dropped;
}
}
