// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/EdgeFlips.h"

#include "mesh/TriangleShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Cosine of the angle between two normals from which on a flip may not bend the surface more.
constexpr float CosineOfBend = 0.5f;
/// Cosine of the angle between two normals below which an edge is a rim of two sheets.
constexpr float CosineOfRim = -0.5f;
/// Triangles lower than a thousandth of their edge have no normal to speak of.
constexpr float SquaredHeightOfSliver = 1e-6f;
constexpr int MaximumPasses = 4;
/// Parts for the executor.
constexpr std::size_t VerticesAskedPerRange = 1024;
constexpr std::size_t VerticesFlippedPerRange = 65536;
/// Of an edge: what lies between it and the one that it is flipped to, if it is flat. Triangles that come to be there
/// are no slivers.
constexpr float MostHeightOfFlat = 0.002f;
constexpr float LeastRatioOfFlat = 0.3f;

bool keepsShape(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d)
{
  const Vector4 pa = mesh.position(a), pb = mesh.position(b);
  const Vector4 pc = mesh.position(c), pd = mesh.position(d);
  const Vector4 old1 = cross(pb - pa, pc - pa), old2 = cross(pa - pb, pd - pb);
  const Vector4 new1 = cross(pd - pa, pc - pa), new2 = cross(pc - pb, pd - pb);
  const Vector4 old = old1 + old2;
  return dot(new1, old) > 0.f && dot(new2, old) > 0.f &&
    cosineBetween(new1, new2) >= std::min(CosineOfBend, cosineBetween(old1, old2));
}

/// Whether a-b is the rim at which two sheets lie back to back, and c-d is shorter. Such sheets
/// span gaps between parts of the surface that the mesh has learnt as one: no sample comes there,
/// so nothing moves them. Flip by flip their rim retracts.
bool isRimOfSheets(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d)
{
  const Vector4 pa = mesh.position(a), pb = mesh.position(b);
  const Vector4 pc = mesh.position(c), pd = mesh.position(d);
  const Vector4 normal1 = cross(pb - pa, pc - pa), normal2 = cross(pa - pb, pd - pb);
  const float length = squaredNorm(pb - pa);
  const float sliver = SquaredHeightOfSliver * length * length;
  return squaredNorm(pd - pc) < length && squaredNorm(normal1) > sliver &&
    squaredNorm(normal2) > sliver && cosineBetween(normal1, normal2) < CosineOfRim;
}

bool isMoreRegular(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d)
{
  return valenceGain(mesh, a, b, c, d) > 0 && keepsShape(mesh, a, b, c, d);
}

/// Whether a-b and c-d lie in a plane, but for a small part of a-b.
bool isFlat(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d)
{
  const Vector4 pa = mesh.position(a), pc = mesh.position(c);
  const Vector4 edge = mesh.position(b) - pa;
  const Vector4 across = cross(edge, mesh.position(d) - pc);
  const float height = dot(across, pc - pa);
  return height * height <=
    MostHeightOfFlat * MostHeightOfFlat * squaredNorm(edge) * squaredNorm(across);
}

using OppositeVertices = std::array<VertexIndex, 2>;

/// Those of a-b, if it is legal to flip that and the edge between them is better: for the valences, or
/// to retract a rim. Else there are none.
template <typename MayTouch>
OppositeVertices betterThan(const Mesh& mesh, VertexIndex a, VertexIndex b, bool retractsRims,
  EdgesToFlip which, const MayTouch& mayTouch)
{
  constexpr OppositeVertices None{ NoVertex, NoVertex };
  const Ring& ring = mesh.ring(a);
  const unsigned slot = ring.find(b);
  if (slot == ring.size())
  {
    return None;
  }
  const VertexIndex c = ring.next(slot);
  const VertexIndex d = ring.previous(slot);
  if (c == NoVertex || d == NoVertex || !mayTouch(c) || !mayTouch(d) ||
    (which == EdgesToFlip::Flat && !isFlat(mesh, a, b, c, d)))
  {
    return None;
  }
  if (which == EdgesToFlip::Flat &&
    std::min(radiusRatio(mesh.position(a), mesh.position(d), mesh.position(c)),
      radiusRatio(mesh.position(b), mesh.position(c), mesh.position(d))) < LeastRatioOfFlat)
  {
    return None;
  }
  const bool isBetter =
    isMoreRegular(mesh, a, b, c, d) || (retractsRims && isRimOfSheets(mesh, a, b, c, d));
  return isBetter && mesh.canFlip(a, b) ? OppositeVertices{ c, d } : None;
}

constexpr auto any = [](VertexIndex) { return true; };

/// Calls `flip(a, b)` for the edges of the triangles around a vertex, as they are in turn, and for those to its
/// neighbours; it tells whether it has flipped the edge. Again, as long as any was. Returns how many were.
template <typename MayTouch, typename FlipEdge>
unsigned flipAround(const Mesh& mesh, VertexIndex v, const MayTouch& mayTouch, const FlipEdge& flip)
{
  unsigned flips = 0;
  bool improved = true;
  for (int pass = 0; improved && pass < MaximumPasses; ++pass)
  {
    improved = false;
    const Ring before = mesh.ring(v);
    for (unsigned slot = 0; slot < before.size(); ++slot)
    {
      const VertexIndex neighbor = before[slot];
      const VertexIndex next = before.next(slot);
      if (!mayTouch(neighbor))
      {
        continue;
      }
      const bool opposite = next != NoVertex && mayTouch(next) &&
        mesh.ring(neighbor).contains(next) && flip(neighbor, next);
      const bool spoke = mesh.ring(v).contains(neighbor) && flip(v, neighbor);
      flips += unsigned(opposite) + unsigned(spoke);
      improved = improved || opposite || spoke;
    }
  }
  return flips;
}

/// The same for those that are better flipped. `onFlip` is told the four vertices of each.
template <typename MayTouch, typename OnFlip>
unsigned flipBetterAround(
  Mesh& mesh, VertexIndex v, EdgesToFlip which, const MayTouch& mayTouch, const OnFlip& onFlip)
{
  return flipAround(mesh, v, mayTouch,
    [&](VertexIndex a, VertexIndex b)
    {
      const OppositeVertices other =
        betterThan(mesh, a, b, which == EdgesToFlip::All, which, mayTouch);
      if (other[0] == NoVertex)
      {
        return false;
      }
      mesh.flip(a, b);
      onFlip(std::array{ a, b, other[0], other[1] });
      return true;
    });
}

constexpr auto ignore = [](const std::array<VertexIndex, 4>&) {};

/// Whether any edge is flipped around a vertex.
bool wouldFlipAround(const Mesh& mesh, VertexIndex v, EdgesToFlip which)
{
  bool would = false;
  flipAround(mesh, v, any,
    [&](VertexIndex a, VertexIndex b)
    {
      would = would || betterThan(mesh, a, b, which == EdgesToFlip::All, which, any)[0] != NoVertex;
      return false;
    });
  return would;
}
}

int valenceGain(const Mesh& mesh, VertexIndex a, VertexIndex b, VertexIndex c, VertexIndex d)
{
  return 2 *
    (mesh.valenceExcess(a) + mesh.valenceExcess(b) - mesh.valenceExcess(c) -
      mesh.valenceExcess(d)) -
    4;
}

bool flipIfMoreRegular(Mesh& mesh, VertexIndex a, VertexIndex b)
{
  if (betterThan(mesh, a, b, false, EdgesToFlip::All, any)[0] == NoVertex)
  {
    return false;
  }
  mesh.flip(a, b);
  return true;
}

bool isFlatEdge(const Mesh& mesh, VertexIndex a, VertexIndex b)
{
  const Ring& ring = mesh.ring(a);
  const unsigned slot = ring.find(b);
  const VertexIndex c = ring.next(slot), d = ring.previous(slot);
  return c != NoVertex && d != NoVertex && isFlat(mesh, a, b, c, d);
}

unsigned flipEdgesAround(Mesh& mesh, VertexIndex v, EdgesToFlip which)
{
  return flipBetterAround(mesh, v, which, any, ignore);
}

unsigned flipMarkedEdgesAround(
  Mesh& mesh, VertexIndex v, std::span<const std::uint64_t> marks, std::uint64_t mark)
{
  return flipBetterAround(
    mesh, v, EdgesToFlip::All, [&](VertexIndex u) { return marks[u] == mark; }, ignore);
}

void flipEdges(Mesh& mesh, EdgesToFlip which, const Executor& executor)
{
  // On several threads, all vertices are asked ahead. What was answered holds as long as there was no flip at the
  // triangles around the vertex, or at those next to these.
  const bool asksAhead = executor.threadCount() > 1;
  std::vector<std::uint8_t> isToBeAsked(mesh.indexEnd(), 1);
  if (asksAhead)
  {
    executor.forEachRange(isToBeAsked.size(), VerticesAskedPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          isToBeAsked[v] = wouldFlipAround(mesh, v, which) ? 1 : 0;
        }
      });
  }
  const auto askAround = [&](const std::array<VertexIndex, 4>& changed)
  {
    for (const VertexIndex v : changed)
    {
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        isToBeAsked[neighbor] = 1;
        for (const VertexIndex far : mesh.ring(neighbor))
        {
          isToBeAsked[far] = 1;
        }
      }
    }
  };
  const auto flipBetween = [&](std::size_t begin, std::size_t end)
  {
    for (auto v = VertexIndex(begin); v < end; ++v)
    {
      if (isToBeAsked[v] == 0)
      {
        continue;
      }
      asksAhead ? flipBetterAround(mesh, v, which, any, askAround)
                : flipBetterAround(mesh, v, which, any, ignore);
    }
  };
  // One range after another: between them a run may end.
  for (std::size_t begin = 0; begin < isToBeAsked.size(); begin += VerticesFlippedPerRange)
  {
    const std::size_t end = std::min(isToBeAsked.size(), begin + VerticesFlippedPerRange);
    executor.forEachPart(1, [&](std::size_t) { flipBetween(begin, end); });
  }
}
}
