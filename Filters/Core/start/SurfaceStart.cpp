// SPDX-License-Identifier: BSD-3-Clause
#include "start/SurfaceStart.h"

#include "mesh/EdgeFlips.h"
#include "mesh/QuadricSimplification.h"
#include "mesh/Refinement.h"

namespace neuralmesh
{
namespace
{
/// Creases and tips count for more than on a mesh that is learnt afterwards.
constexpr double Evenness = 1e-4;
/// Of the radius ratio: with less, normals tell little.
constexpr float LeastShape = 0.25f;
}

bool startFromSurface(Mesh& mesh, std::size_t count, const Progress& progress)
{
  if (mesh.vertexCount() < count && !refine(mesh, count, progress, EdgesAfterSplit::FlipFlat))
  {
    return false;
  }
  simplifyByQuadrics(mesh, count, Evenness, LeastShape);
  flipEdges(mesh, EdgesToFlip::Flat);
  return progress(1.);
}
}
