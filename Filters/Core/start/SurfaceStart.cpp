// SPDX-License-Identifier: BSD-3-Clause
#include "start/SurfaceStart.h"

#include "mesh/EdgeFlips.h"
#include "mesh/NearestTriangle.h"
#include "mesh/QuadricSimplification.h"
#include "mesh/Refinement.h"
#include "mesh/Smoothing.h"

#include <cmath>
#include <cstdlib>
#include <vector>

namespace neuralmesh
{
namespace
{
const int RoundsOfSliding = getenv("SL") ? atoi(getenv("SL")) : 5;
const float RateOfSliding = getenv("RT") ? float(atof(getenv("RT"))) : 0.5f;
/// A vertex stays if a triangle would turn by more than this.
const float LeastCosineOfSlide = getenv("LC") ? float(atof(getenv("LC"))) : 0.94f;
constexpr double EndOfSimplification = 0.7;
constexpr std::size_t VerticesPerSlide = 256;

TriangleMesh trianglesIn(const Mesh& mesh)
{
  TriangleMesh result;
  result.points.reserve(mesh.indexEnd());
  for (const Vector4 position : mesh.positions())
  {
    result.points.push_back(position.toDouble());
  }
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c) {
      result.triangles.push_back({ a, b, c });
    });
  return result;
}

/// Whether no triangle of a vertex turns by much if that goes to `place`.
bool keepsNormals(const Mesh& mesh, VertexIndex v, Vector4 place)
{
  const Ring& ring = mesh.ring(v);
  const Vector4 from = mesh.position(v);
  for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
  {
    const Vector4 b = mesh.position(ring[slot]), c = mesh.position(ring[ring.after(slot)]);
    const Vector4 before = cross(b - from, c - from), after = cross(b - place, c - place);
    const float lengths = std::sqrt(squaredNorm(before) * squaredNorm(after));
    if (!(dot(before, after) > LeastCosineOfSlide * lengths))
    {
      return false;
    }
  }
  return true;
}

/// All at once: places are those of before.
void slideVertices(Mesh& mesh, const NearestTriangle& surface, const Executor& executor)
{
  std::vector<Vector4> places(mesh.positions().begin(), mesh.positions().end());
  executor.forEachRange(mesh.indexEnd(), VerticesPerSlide,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        if (!mesh.isBoundary(v))
        {
          const Vector4 slid = smoothedPosition(mesh, v, RateOfSliding);
          places[v] = Vector4(surface.find(slid.toDouble()).place);
        }
      }
    });
  // One after the other, as neighbours that both move may turn a triangle that neither does.
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (!mesh.isBoundary(v) && keepsNormals(mesh, v, places[v]))
    {
      mesh.setPosition(v, places[v]);
    }
  }
}
}

bool startFromSurface(
  Mesh& mesh, std::size_t count, const Progress& progress, const Executor& executor)
{
  const NearestTriangle surface(trianglesIn(mesh));
  if (!progress(0.))
  {
    return false;
  }
  if (mesh.vertexCount() < count)
  {
    if (!refine(mesh, count, partOf(progress, 0., EndOfSimplification), EdgesAfterSplit::FlipFlat))
    {
      return false;
    }
  }
  else
  {
    simplifyByQuadrics(mesh, count);
  }
  for (int round = 0; round < RoundsOfSliding; ++round)
  {
    if (!progress(
          EndOfSimplification + (1. - EndOfSimplification) * double(round) / RoundsOfSliding))
    {
      return false;
    }
    flipEdges(mesh, EdgesToFlip::Flat);
    slideVertices(mesh, surface, executor);
  }
  flipEdges(mesh, EdgesToFlip::Flat);
  return true;
}
}
