// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoundaryManager.h"

#include "base/Archive.h"
#include "mesh/Renumbering.h"

#include <algorithm>

namespace neuralmesh
{
BoundaryManager::BoundaryManager(const Mesh& mesh)
  : loopOf_(mesh.indexEnd(), NoLoop)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    trace(mesh, v);
  }
}

std::vector<VertexIndex> BoundaryManager::vertices(const Mesh& mesh, LoopIndex loop) const
{
  std::vector<VertexIndex> result;
  result.reserve(loops_[loop].size);
  VertexIndex v = loops_[loop].first;
  for (std::uint32_t i = 0; i < loops_[loop].size; ++i)
  {
    result.push_back(v);
    v = mesh.ring(v).back();
  }
  return result;
}

void BoundaryManager::split(VertexIndex v, VertexIndex added)
{
  if (added >= loopOf_.size())
  {
    loopOf_.resize(added + std::size_t(1), NoLoop);
  }
  const LoopIndex loop = loopOf(v);
  loopOf_[added] = loop;
  if (loop != NoLoop)
  {
    ++loops_[loop].size;
  }
}

void BoundaryManager::collapse(VertexIndex removed, VertexIndex kept)
{
  const LoopIndex loop = loopOf(removed);
  if (loop == NoLoop)
  {
    return;
  }
  --loops_[loop].size;
  if (loops_[loop].first == removed)
  {
    loops_[loop].first = kept; // along the boundary, as no other collapse is legal
  }
  loopOf_[removed] = NoLoop;
}

void BoundaryManager::retrace(const Mesh& mesh, std::span<const VertexIndex> changed)
{
  loopOf_.resize(std::max(loopOf_.size(), mesh.indexEnd()), NoLoop);
  for (const VertexIndex v : changed)
  {
    forget(v);
  }
  for (const VertexIndex v : changed)
  {
    trace(mesh, v);
  }
}

void BoundaryManager::renumber(std::span<const VertexIndex> permutation)
{
  std::vector<LoopIndex> loopOfNew;
  loopOfNew.reserve(permutation.size());
  for (const VertexIndex v : permutation)
  {
    loopOfNew.push_back(loopOf(v));
  }
  loopOf_ = std::move(loopOfNew);
  const std::vector<VertexIndex> newIndex = newIndices(permutation);
  for (Loop& loop : loops_)
  {
    if (loop.size > 0)
    {
      loop.first = newIndex[loop.first];
    }
  }
}

void BoundaryManager::exchange(Archive& archive, const Mesh& mesh)
{
  archive(loops_, unused_);
  if (archive.isReading())
  {
    archive.require(findVertices(mesh));
    archive.require(std::all_of(unused_.begin(), unused_.end(),
      [this](LoopIndex loop) { return loop < loops_.size() && loops_[loop].size == 0; }));
  }
}

/// Which vertices lie in the loops. False if those are not the boundaries of the mesh.
bool BoundaryManager::findVertices(const Mesh& mesh)
{
  loopOf_.assign(mesh.indexEnd(), NoLoop);
  const auto isFree = [&](VertexIndex v)
  { return v < mesh.indexEnd() && mesh.isAlive(v) && mesh.isBoundary(v) && loopOf_[v] == NoLoop; };
  for (LoopIndex loop = 0; loop < loops_.size(); ++loop)
  {
    const auto [first, size] = loops_[loop];
    VertexIndex v = first;
    for (std::uint32_t i = 0; i < size; ++i)
    {
      if (!isFree(v))
      {
        return false;
      }
      loopOf_[v] = loop;
      v = mesh.ring(v).back();
    }
    if (size > 0 && v != first)
    {
      return false;
    }
  }
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (isFree(v))
    {
      return false;
    }
  }
  return true;
}

void BoundaryManager::forget(VertexIndex v)
{
  const LoopIndex loop = loopOf(v);
  if (loop == NoLoop)
  {
    return;
  }
  loopOf_[v] = NoLoop;
  if (loops_[loop].size > 0)
  {
    loops_[loop] = {};
    unused_.push_back(loop);
  }
}

void BoundaryManager::trace(const Mesh& mesh, VertexIndex first)
{
  const auto isInLoop = [&](VertexIndex v)
  { return loopOf_[v] != NoLoop && loops_[loopOf_[v]].size > 0; };
  if (!mesh.isAlive(first) || !mesh.isBoundary(first) || isInLoop(first))
  {
    return;
  }
  LoopIndex loop = LoopIndex(loops_.size());
  if (unused_.empty())
  {
    loops_.emplace_back();
  }
  else
  {
    loop = unused_.back();
    unused_.pop_back();
  }
  loops_[loop].first = first;
  VertexIndex v = first;
  do
  {
    loopOf_[v] = loop;
    ++loops_[loop].size;
    v = mesh.ring(v).back();
  } while (v != first);
}
}
