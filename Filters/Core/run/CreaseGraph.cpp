// SPDX-License-Identifier: BSD-3-Clause
#include "run/CreaseGraph.h"

#include "base/DisjointSets.h"

#include <algorithm>
#include <map>
#include <utility>

namespace neuralmesh
{
namespace
{
/// By the width of patches: what is no longer and ends in the open is no line, nor is a piece with fewer
/// confirmed edges.
constexpr std::size_t LongestSpur = 3;
constexpr std::size_t FewestConfirmed = 4;
/// Edges that close a gap in a line.
constexpr std::size_t LongestGap = 10;
}

CreaseGraph::CreaseGraph(std::vector<CreaseEdge> edges, const Mesh& mesh, unsigned width)
  : mesh_(mesh)
  , width_(width)
  , edges_(std::move(edges))
  , isThere_(edges_.size())
  , allAt_(mesh.indexEnd())
  , edgesAt_(mesh.indexEnd())
{
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
  {
    allAt_[edges_[e].ends[0]].push_back(e);
    allAt_[edges_[e].ends[1]].push_back(e);
  }
}

void CreaseGraph::prune()
{
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
  {
    if (edges_[e].isConfirmed)
    {
      add(e);
    }
  }
  closeGaps();
  // Where one has gone, what was two paths is one.
  while (dropPaths([this](const Path& path) { return isSpur(path); }) || dropDetours())
  {
  }
  dropSmallPieces();
}

VertexIndex CreaseGraph::otherEnd(std::uint32_t edge, VertexIndex v) const
{
  const auto& ends = edges_[edge].ends;
  return ends[0] == v ? ends[1] : ends[0];
}

std::vector<CreaseGraph::Path> CreaseGraph::paths(const std::vector<bool>& isEnd) const
{
  std::vector<Path> result;
  std::vector<bool> isTaken(edges_.size());
  const auto endsAt = [&](VertexIndex v) { return degree(v) != 2 || (!isEnd.empty() && isEnd[v]); };
  const auto follow = [&](VertexIndex from, std::uint32_t e)
  {
    Path path{ {}, { from } };
    for (;;)
    {
      isTaken[e] = true;
      const VertexIndex v = otherEnd(e, path.vertices.back());
      path.edges.push_back(e);
      path.vertices.push_back(v);
      if (v == from || endsAt(v))
      {
        result.push_back(std::move(path));
        return;
      }
      e = edgesAt_[v][0] == e ? edgesAt_[v][1] : edgesAt_[v][0];
    }
  };
  const auto followAll = [&](VertexIndex v)
  {
    for (const std::uint32_t e : edgesAt_[v])
    {
      if (!isTaken[e])
      {
        follow(v, e);
      }
    }
  };
  for (VertexIndex v = 0; v < edgesAt_.size(); ++v)
  {
    if (endsAt(v))
    {
      followAll(v);
    }
  }
  // What is left are loops.
  for (VertexIndex v = 0; v < edgesAt_.size(); ++v)
  {
    followAll(v);
  }
  return result;
}

void CreaseGraph::add(std::uint32_t edge)
{
  isThere_[edge] = true;
  for (const VertexIndex v : edges_[edge].ends)
  {
    edgesAt_[v].push_back(edge);
  }
}

void CreaseGraph::drop(std::uint32_t edge)
{
  isThere_[edge] = false;
  for (const VertexIndex v : edges_[edge].ends)
  {
    std::erase(edgesAt_[v], edge);
  }
}

void CreaseGraph::closeGaps()
{
  for (VertexIndex v = 0; v < edgesAt_.size(); ++v)
  {
    if (isOpenEnd(v))
    {
      for (const std::uint32_t e : shortestWay(v))
      {
        add(e);
      }
    }
  }
}

/// The fewest edges that lead from the end of a line to any line, away from it; none if there are too many.
std::vector<std::uint32_t> CreaseGraph::shortestWay(VertexIndex from) const
{
  struct Stop
  {
    VertexIndex vertex;
    std::uint32_t edge;
    std::size_t before;
    std::size_t length;
  };
  std::vector<Stop> steps{ { from, edgesAt_[from][0], 0, 0 } };
  const VertexIndex behind = otherEnd(edgesAt_[from][0], from);
  for (std::size_t i = 0; i < steps.size() && steps[i].length < LongestGap; ++i)
  {
    for (const std::uint32_t e : allAt_[steps[i].vertex])
    {
      const VertexIndex v = otherEnd(e, steps[i].vertex);
      if (isThere_[e] || v == behind ||
        std::any_of(steps.begin(), steps.end(), [v](const Stop& step) { return step.vertex == v; }))
      {
        continue;
      }
      steps.push_back({ v, e, i, steps[i].length + 1 });
      if (degree(v) > 0)
      {
        std::vector<std::uint32_t> way;
        for (std::size_t step = steps.size() - 1; step > 0; step = steps[step].before)
        {
          way.push_back(steps[step].edge);
        }
        return way;
      }
    }
  }
  return {};
}

template <typename Condition>
bool CreaseGraph::dropPaths(const Condition& isToGo)
{
  bool hasDropped = false;
  for (const Path& path : paths())
  {
    if (isToGo(path))
    {
      std::for_each(path.edges.begin(), path.edges.end(), [this](std::uint32_t e) { drop(e); });
      hasDropped = true;
    }
  }
  return hasDropped;
}

bool CreaseGraph::isSpur(const Path& path) const
{
  return path.edges.size() <= LongestSpur * width_ &&
    (isOpenEnd(path.vertices.front()) || isOpenEnd(path.vertices.back()) || path.isLoop());
}

/// Of short paths between the same two ends only the shortest stays: what lies between them is a few triangles
/// that are taken for either side.
bool CreaseGraph::dropDetours()
{
  std::map<std::pair<VertexIndex, VertexIndex>, Path> shortest;
  bool hasDropped = false;
  for (Path& path : paths())
  {
    if (path.isLoop() || path.edges.size() > LongestSpur * width_)
    {
      continue;
    }
    const auto ends = std::minmax(path.vertices.front(), path.vertices.back());
    const auto [place, isFirst] = shortest.try_emplace(ends, path);
    if (isFirst)
    {
      continue;
    }
    if (path.edges.size() < place->second.edges.size())
    {
      std::swap(path, place->second);
    }
    std::for_each(path.edges.begin(), path.edges.end(), [this](std::uint32_t e) { drop(e); });
    hasDropped = true;
  }
  return hasDropped;
}

void CreaseGraph::dropSmallPieces()
{
  DisjointSets pieces(edgesAt_.size());
  std::vector<std::size_t> confirmed(edgesAt_.size());
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
  {
    if (isThere_[e])
    {
      pieces.join(edges_[e].ends[0], edges_[e].ends[1]);
    }
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
  {
    confirmed[pieces.root(edges_[e].ends[0])] += isThere_[e] && edges_[e].isConfirmed ? 1 : 0;
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
  {
    if (isThere_[e] && confirmed[pieces.root(edges_[e].ends[0])] < FewestConfirmed * width_)
    {
      drop(e);
    }
  }
}
}
