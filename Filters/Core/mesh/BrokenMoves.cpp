// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BrokenMoves.h"

#include "mesh/SelfIntersections.h"

#include <vector>

namespace neuralmesh
{
namespace
{
/// Of what breaks at once some hangs together.
constexpr int MostTakingsBack = 8;
}

AfterBrokenMoves takeBackBrokenMoves(
  Mesh& mesh, const PackedVectors& before, const Progress& progress, const Executor& executor)
{
  std::vector<bool> isAsked(mesh.indexEnd(), true);
  AfterBrokenMoves result = AfterBrokenMoves::Sound;
  bool hasMoved = true;
  for (int time = 0; time < MostTakingsBack && hasMoved; ++time)
  {
    if (!progress(0.))
    {
      return AfterBrokenMoves::Cancelled;
    }
    const std::vector<VertexIndex> broken = brokenVertices(mesh, isAsked, executor);
    isAsked.assign(isAsked.size(), false);
    hasMoved = false;
    for (const VertexIndex v : broken)
    {
      if (squaredNorm(mesh.position(v) - before[v]) > 0.f)
      {
        mesh.setPosition(v, before[v]);
        isAsked[v] = hasMoved = true;
      }
    }
    result = !broken.empty() ? AfterBrokenMoves::Broken
      : time == 0            ? AfterBrokenMoves::Untouched
                             : AfterBrokenMoves::Sound;
  }
  return result;
}
}
