// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryManager.h"

#include "Archive.h"
#include "Renumbering.h"

#include <algorithm>

namespace neuralmesh
{
BoundaryManager::BoundaryManager(const Mesh& mesh)
  : loopOf_(mesh.indexEnd(), NoLoop)
{
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    this->trace(mesh, v);
  }
}

std::vector<VertexIndex> BoundaryManager::vertices(const Mesh& mesh, LoopIndex loop) const
{
  std::vector<VertexIndex> result;
  result.reserve(this->loops_[loop].size);
  VertexIndex v = this->loops_[loop].first;
  for (std::uint32_t i = 0; i < this->loops_[loop].size; ++i)
  {
    result.push_back(v);
    v = mesh.ring(v).back();
  }
  return result;
}

void BoundaryManager::split(VertexIndex v, VertexIndex added)
{
  if (added >= this->loopOf_.size())
  {
    this->loopOf_.resize(added + std::size_t(1), NoLoop);
  }
  const LoopIndex loop = this->loopOf(v);
  this->loopOf_[added] = loop;
  if (loop != NoLoop)
  {
    ++this->loops_[loop].size;
  }
}

void BoundaryManager::collapse(VertexIndex removed, VertexIndex kept)
{
  const LoopIndex loop = this->loopOf(removed);
  if (loop == NoLoop)
  {
    return;
  }
  --this->loops_[loop].size;
  if (this->loops_[loop].first == removed)
  {
    this->loops_[loop].first = kept; // along the boundary, as no other collapse is legal
  }
  this->loopOf_[removed] = NoLoop;
}

void BoundaryManager::retrace(const Mesh& mesh, std::span<const VertexIndex> changed)
{
  this->loopOf_.resize(std::max(this->loopOf_.size(), mesh.indexEnd()), NoLoop);
  for (const VertexIndex v : changed)
  {
    this->forget(v);
  }
  for (const VertexIndex v : changed)
  {
    this->trace(mesh, v);
  }
}

void BoundaryManager::renumber(std::span<const VertexIndex> order)
{
  std::vector<LoopIndex> loopOf;
  loopOf.reserve(order.size());
  for (const VertexIndex v : order)
  {
    loopOf.push_back(this->loopOf(v));
  }
  this->loopOf_ = std::move(loopOf);
  const std::vector<VertexIndex> newIndex = newIndices(order);
  for (Loop& loop : this->loops_)
  {
    if (loop.size > 0)
    {
      loop.first = newIndex[loop.first];
    }
  }
}

void BoundaryManager::exchange(Archive& archive, const Mesh& mesh)
{
  archive(this->loops_, this->unused_);
  if (archive.isReading())
  {
    archive.require(this->findVertices(mesh));
    archive.require(std::all_of(this->unused_.begin(), this->unused_.end(),
      [this](LoopIndex loop)
      { return loop < this->loops_.size() && this->loops_[loop].size == 0; }));
  }
}

/// Which vertices lie in the loops. False if those are not the boundaries of the mesh.
bool BoundaryManager::findVertices(const Mesh& mesh)
{
  this->loopOf_.assign(mesh.indexEnd(), NoLoop);
  const auto isFree = [&](VertexIndex v)
  {
    return v < mesh.indexEnd() && mesh.isAlive(v) && mesh.isBoundary(v) &&
      this->loopOf_[v] == NoLoop;
  };
  for (LoopIndex loop = 0; loop < this->loops_.size(); ++loop)
  {
    const auto [first, size] = this->loops_[loop];
    VertexIndex v = first;
    for (std::uint32_t i = 0; i < size; ++i)
    {
      if (!isFree(v))
      {
        return false;
      }
      this->loopOf_[v] = loop;
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
  const LoopIndex loop = this->loopOf(v);
  if (loop == NoLoop)
  {
    return;
  }
  this->loopOf_[v] = NoLoop;
  if (this->loops_[loop].size > 0)
  {
    this->loops_[loop] = {};
    this->unused_.push_back(loop);
  }
}

void BoundaryManager::trace(const Mesh& mesh, VertexIndex first)
{
  const auto isInLoop = [&](VertexIndex v)
  { return this->loopOf_[v] != NoLoop && this->loops_[this->loopOf_[v]].size > 0; };
  if (!mesh.isAlive(first) || !mesh.isBoundary(first) || isInLoop(first))
  {
    return;
  }
  LoopIndex loop = LoopIndex(this->loops_.size());
  if (this->unused_.empty())
  {
    this->loops_.emplace_back();
  }
  else
  {
    loop = this->unused_.back();
    this->unused_.pop_back();
  }
  this->loops_[loop].first = first;
  VertexIndex v = first;
  do
  {
    this->loopOf_[v] = loop;
    ++this->loops_[loop].size;
    v = mesh.ring(v).back();
  } while (v != first);
}
}
