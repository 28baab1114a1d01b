// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossingRemoval.h"

#include "mesh/BoundaryFilling.h"
#include "mesh/SelfIntersections.h"

namespace neuralmesh
{
namespace
{
constexpr int MostRoundsOfRemoval = 3;
}

void removeCrossings(Mesh& mesh)
{
  for (int round = 0; round < MostRoundsOfRemoval; ++round)
  {
    const std::vector<Triangle> crossing = intersectingTriangles(mesh);
    if (crossing.empty())
    {
      break;
    }
    mesh.removeTriangles(crossing);
  }
}

void replaceCrossings(Mesh& mesh)
{
  removeCrossings(mesh);
  fillSmallGaps(mesh);
  removeCrossings(mesh);
}
}
