// SPDX-License-Identifier: BSD-3-Clause
#include "fit/EmptyPieces.h"

#include "base/ConcurrentSets.h"
#include "base/ZeroedArray.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace neuralmesh
{
Vector4 centerOf(const Mesh& mesh, const Triangle& triangle)
{
  return 1.f / 3.f *
    (mesh.position(triangle[0]) + mesh.position(triangle[1]) + mesh.position(triangle[2]));
}

Vector4 crossOf(const Mesh& mesh, const Triangle& triangle)
{
  const Vector4 a = mesh.position(triangle[0]);
  return cross(mesh.position(triangle[1]) - a, mesh.position(triangle[2]) - a);
}

namespace
{
/// Parts for the executor.
constexpr std::size_t VerticesOfEmptyPart = 4096;
constexpr std::size_t PiecesOfPart = 64;

/// Joins the empty triangles that have a vertex in common.
void joinEmpty(const NumberedTriangles& triangles, std::size_t vertices,
  std::span<const std::uint8_t> isEmpty, const Executor& executor, ConcurrentSets& sets)
{
  executor.forEachRange(vertices, VerticesOfEmptyPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        const auto around = triangles.at(v);
        const auto first = std::find_if(
          around.begin(), around.end(), [&](std::uint32_t t) { return isEmpty[t] != 0; });
        for (auto t = first; t != around.end(); ++t)
        {
          if (isEmpty[*t] != 0)
          {
            sets.join(*t, *first);
          }
        }
      }
    });
}

/// Those that are not empty and touch some of `these`, in rising order.
std::vector<std::uint32_t> touching(std::span<const std::uint32_t> these,
  const NumberedTriangles& triangles, std::span<const std::uint8_t> isEmpty)
{
  std::vector<std::uint32_t> around;
  for (const std::uint32_t t : these)
  {
    for (const VertexIndex v : triangles.all()[t])
    {
      const auto at = triangles.at(v);
      std::copy_if(at.begin(), at.end(), std::back_inserter(around),
        [&](std::uint32_t other) { return isEmpty[other] == 0; });
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

/// Adds up what a piece is, and what lies around it, in the order of the triangles.
void describe(EmptyPiece& piece, const Mesh& mesh, const NumberedTriangles& triangles,
  std::span<const std::uint32_t> samples, std::span<const std::uint8_t> isEmpty)
{
  for (const std::uint32_t t : piece.triangles)
  {
    const Triangle& triangle = triangles.all()[t];
    piece.area += areaOf(mesh, triangle);
    piece.isAtBoundary = piece.isAtBoundary ||
      std::any_of(
        triangle.begin(), triangle.end(), [&](VertexIndex v) { return mesh.isBoundary(v); });
  }
  const std::vector<std::uint32_t> around = touching(piece.triangles, triangles, isEmpty);
  for (const std::uint32_t t : around)
  {
    piece.areaAround += areaOf(mesh, triangles.all()[t]);
    piece.samplesAround += samples[t];
  }
  for (const std::uint32_t t : touching(around, triangles, isEmpty))
  {
    if (!std::binary_search(around.begin(), around.end(), t))
    {
      piece.areaBeyond += areaOf(mesh, triangles.all()[t]);
      piece.samplesBeyond += samples[t];
      piece.normalBeyond += crossOf(mesh, triangles.all()[t]);
    }
  }
}
}

std::vector<EmptyPiece> findEmptyPieces(const Mesh& mesh, const NumberedTriangles& triangles,
  std::span<const std::uint32_t> samples, std::span<const std::uint8_t> isEmpty,
  const Executor& executor)
{
  if (std::find(isEmpty.begin(), isEmpty.end(), 1) == isEmpty.end())
  {
    return {};
  }
  ConcurrentSets sets(samples.size(), executor);
  joinEmpty(triangles, mesh.indexEnd(), isEmpty, executor, sets);
  // A set is known by its first triangle: so pieces are in the order of these.
  std::vector<EmptyPiece> pieces;
  ZeroedArray<std::uint32_t> pieceOf(samples.size());
  for (std::uint32_t t = 0; t < samples.size(); ++t)
  {
    if (isEmpty[t] == 0)
    {
      continue;
    }
    const std::size_t first = sets.root(t);
    if (first == t)
    {
      pieceOf[t] = std::uint32_t(pieces.size());
      pieces.emplace_back();
    }
    pieces[pieceOf[first]].triangles.push_back(t);
  }
  executor.forEachRange(pieces.size(), PiecesOfPart,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        describe(pieces[i], mesh, triangles, samples, isEmpty);
      }
    });
  return pieces;
}

bool isTube(const EmptyPiece& piece, const NumberedTriangles& triangles)
{
  std::set<VertexIndex> vertices;
  std::set<std::pair<VertexIndex, VertexIndex>> edges;
  for (const std::uint32_t t : piece.triangles)
  {
    const auto& [a, b, c] = triangles.all()[t];
    vertices.insert({ a, b, c });
    edges.insert({ std::minmax(a, b), std::minmax(b, c), std::minmax(c, a) });
  }
  return vertices.size() + piece.triangles.size() <= edges.size();
}
}
