// SPDX-License-Identifier: BSD-3-Clause
#include "fit/EmptyPieces.h"

#include "base/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
double areaOf(const Mesh& mesh, const Triangle& triangle)
{
  const Vector4 a = mesh.position(triangle[0]);
  return 0.5 *
    std::sqrt(
      double(squaredNorm(cross(mesh.position(triangle[1]) - a, mesh.position(triangle[2]) - a))));
}

Vector4 centerOf(const Mesh& mesh, const Triangle& triangle)
{
  return 1.f / 3.f *
    (mesh.position(triangle[0]) + mesh.position(triangle[1]) + mesh.position(triangle[2]));
}

std::vector<EmptyPiece> findEmptyPieces(const Mesh& mesh, const NumberedTriangles& triangles,
  std::span<const std::uint32_t> samples, const std::vector<bool>& isEmpty)
{
  if (std::find(isEmpty.begin(), isEmpty.end(), true) == isEmpty.end())
  {
    return {};
  }
  DisjointSets sets(samples.size());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    const auto around = triangles.at(v);
    const auto first =
      std::find_if(around.begin(), around.end(), [&](std::uint32_t t) { return isEmpty[t]; });
    for (const std::uint32_t t : around)
    {
      if (isEmpty[t])
      {
        sets.join(t, *first);
      }
    }
  }
  std::vector<EmptyPiece> pieces;
  std::vector<std::uint32_t> pieceOf(samples.size(), 0);
  const auto pieceWith = [&](std::uint32_t t) -> EmptyPiece&
  {
    std::uint32_t& number = pieceOf[sets.root(t)];
    if (number == 0)
    {
      pieces.emplace_back();
      number = std::uint32_t(pieces.size());
    }
    return pieces[number - 1];
  };
  std::vector<std::size_t> touched;
  for (std::uint32_t t = 0; t < samples.size(); ++t)
  {
    if (isEmpty[t])
    {
      EmptyPiece& piece = pieceWith(t);
      piece.area += areaOf(mesh, triangles.all()[t]);
      piece.triangles.push_back(t);
      const auto& corners = triangles.all()[t];
      piece.isAtBoundary = piece.isAtBoundary ||
        std::any_of(
          corners.begin(), corners.end(), [&](VertexIndex v) { return mesh.isBoundary(v); });
      continue;
    }
    touched.clear();
    for (const VertexIndex v : triangles.all()[t])
    {
      for (const std::uint32_t other : triangles.at(v))
      {
        if (!isEmpty[other])
        {
          continue;
        }
        const std::size_t root = sets.root(other);
        if (std::find(touched.begin(), touched.end(), root) == touched.end())
        {
          touched.push_back(root);
          EmptyPiece& piece = pieceWith(other);
          piece.areaAround += areaOf(mesh, triangles.all()[t]);
          piece.samplesAround += samples[t];
        }
      }
    }
  }
  return pieces;
}
}
