// SPDX-License-Identifier: BSD-3-Clause
#include "start/SurfaceStart.h"

#include "mesh/EdgeFlips.h"
#include "mesh/QuadricSimplification.h"
#include "mesh/Refinement.h"

namespace neuralmesh
{
bool startFromSurface(Mesh& mesh, std::size_t count, const Progress& progress)
{
  if (mesh.vertexCount() < count && !refine(mesh, count, progress, EdgesAfterSplit::FlipFlat))
  {
    return false;
  }
  simplifySurface(mesh, count);
  flipEdges(mesh, EdgesToFlip::Flat);
  return progress(1.);
}
}
