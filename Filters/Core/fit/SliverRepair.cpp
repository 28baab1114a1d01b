// SPDX-License-Identifier: BSD-3-Clause
#include "fit/SliverRepair.h"

#include "mesh/Refinement.h"
#include "mesh/SelfIntersections.h"
#include "mesh/SliverRemoval.h"
#include "mesh/StoredMesh.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A triangle of less quality is a sliver.
constexpr float LeastQuality = 0.1f;
/// The removal is repeated: new vertices halve slivers that are left, and other slivers can go
/// after their neighbours.
constexpr int MostTimes = 6;
/// Each attempt refuses more changes.
constexpr int MostAttempts = 16;

/// The differences in defects around changes.
struct NewDefects
{
  long crossings = 0;  ///< triangles, fewer if negative
  long folds = 0;      ///< the same of edges
  std::vector<int> at; ///< of each vertex

  bool any() const { return crossings > 0 || folds > 0; }
};

NewDefects newDefects(const Mesh& mesh, const StoredMesh& before,
  const std::vector<AppliedChange>& changes, const Executor& executor)
{
  std::vector<bool> isTouched(mesh.indexEnd(), false);
  for (const AppliedChange& applied : changes)
  {
    for (const VertexIndex v : applied.touched)
    {
      isTouched[v] = true;
    }
  }
  NewDefects defects{ 0, 0, std::vector<int>(mesh.indexEnd(), 0) };
  const auto count = [&](const Mesh& counted, int sign)
  {
    const std::vector<Triangle> crossings = intersectingTriangles(counted, isTouched, executor);
    const std::vector<Edge> folds = foldedEdges(counted, isTouched, executor);
    defects.crossings += sign * long(crossings.size());
    defects.folds += sign * long(folds.size());
    for (const Triangle& triangle : crossings)
    {
      for (const VertexIndex v : triangle)
      {
        defects.at[v] += sign;
      }
    }
    for (const Edge& edge : folds)
    {
      for (const VertexIndex v : edge)
      {
        defects.at[v] += sign;
      }
    }
  };
  count(mesh, 1);
  count(before.mesh(executor), -1);
  return defects;
}

/// Removes slivers, and refuses changes until none causes a defect. Returns false if no change is
/// left; the mesh is undefined then.
bool removeUnbroken(Mesh& mesh, const StoredMesh& before, const Executor& executor)
{
  std::set<SliverChange> refused;
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    if (attempt > 0)
    {
      mesh = before.mesh(executor);
    }
    const std::vector<AppliedChange> changes = removeSlivers(mesh, LeastQuality, refused, executor);
    if (changes.empty())
    {
      return false;
    }
    const NewDefects defects = newDefects(mesh, before, changes, executor);
    if (!defects.any())
    {
      return true;
    }
    for (const AppliedChange& applied : changes)
    {
      if (std::any_of(applied.touched.begin(), applied.touched.end(),
            [&](VertexIndex v) { return defects.at[v] > 0; }))
      {
        refused.insert(applied.change);
      }
    }
  }
  return false;
}

bool repairOnce(Mesh& mesh, FitGuard& guard, const Executor& executor)
{
  const StoredMesh before(mesh, executor);
  bool isBetter = removeUnbroken(mesh, before, executor);
  if (isBetter)
  {
    mesh.dropErased();
    refine(
      mesh, before.vertexCount(), [](double) { return true; }, EdgesAfterSplit::Keep);
    isBetter = mesh.vertexCount() == before.vertexCount() &&
      (!guard.losesPoints(mesh, false) || guard.losesPoints(before.mesh(executor), false));
  }
  if (!isBetter)
  {
    mesh = before.mesh(executor);
  }
  return isBetter;
}
}

void repairSlivers(Mesh& mesh, FitGuard& guard, const Executor& executor)
{
  for (int time = 0; time < MostTimes && repairOnce(mesh, guard, executor); ++time)
  {
  }
}
}
