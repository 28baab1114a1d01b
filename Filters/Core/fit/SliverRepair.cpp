// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SliverRepair.h"

#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SliverRemoval.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of triangles.
constexpr float LeastQuality = 0.1f;
/// Vertices that come in again halve slivers that are left, and where some have gone others can.
constexpr int MostTimes = 6;
/// Each refuses more changes.
constexpr int MostAttempts = 16;

/// By how many defects each vertex has more than before, of those around the changes.
std::vector<int> newDefects(
  const Mesh& mesh, const Mesh& before, const std::vector<AppliedChange>& changes)
{
  std::vector<bool> isTouched(mesh.indexEnd(), false);
  for (const AppliedChange& applied : changes)
  {
    for (const VertexIndex v : applied.touched)
    {
      isTouched[v] = true;
    }
  }
  std::vector<int> defects(mesh.indexEnd(), 0);
  for (const VertexIndex v : brokenVertices(mesh, isTouched))
  {
    ++defects[v];
  }
  for (const VertexIndex v : brokenVertices(before, isTouched))
  {
    --defects[v];
  }
  return defects;
}

/// Until nothing is broken that was not before. Returns whether there is something to gain: else the mesh is
/// not what it was.
bool removeUnbroken(Mesh& mesh)
{
  const Mesh before = mesh;
  std::set<SliverChange> refused;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    mesh = before;
    const std::vector<AppliedChange> changes = removeSlivers(mesh, LeastQuality, refused);
    const std::vector<int> defects = newDefects(mesh, before, changes);
    if (changes.empty() || std::accumulate(defects.begin(), defects.end(), 0) <= 0)
    {
      return !changes.empty();
    }
    for (const AppliedChange& applied : changes)
    {
      if (std::any_of(applied.touched.begin(), applied.touched.end(),
            [&](VertexIndex v) { return defects[v] > 0; }))
      {
        refused.insert(applied.change);
      }
    }
  }
  return false;
}

bool repairOnce(Mesh& mesh, FitGuard& guard)
{
  const Mesh before = mesh;
  bool isBetter = removeUnbroken(mesh);
  if (isBetter)
  {
    mesh.dropErased();
    refine(
      mesh, before.vertexCount(), [](double) { return true; }, EdgesAfterSplit::Keep);
    isBetter = mesh.vertexCount() == before.vertexCount() &&
      (!guard.losesPoints(mesh, false) || guard.losesPoints(before, false));
  }
  if (!isBetter)
  {
    mesh = before;
  }
  return isBetter;
}
}

void repairSlivers(Mesh& mesh, FitGuard& guard)
{
  for (int time = 0; time < MostTimes && repairOnce(mesh, guard); ++time)
  {
  }
}
}
