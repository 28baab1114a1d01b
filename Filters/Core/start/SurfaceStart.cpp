// SPDX-License-Identifier: BSD-3-Clause
#include "start/SurfaceStart.h"

#include "mesh/EdgeFlips.h"
#include "mesh/QuadricSimplification.h"

namespace neuralmesh
{
bool startFromSurface(Mesh& mesh, std::size_t count, const Progress& progress)
{
  if (!progress(0.))
  {
    return false;
  }
  simplifySurface(mesh, count);
  flipEdges(mesh, EdgesToFlip::Flat);
  return progress(1.);
}
}
