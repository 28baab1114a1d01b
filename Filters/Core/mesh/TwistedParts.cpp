// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TwistedParts.h"

#include "base/DisjointSets.h"
#include "mesh/FacingBoundaries.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A neck has so few edges from its middle to its sides.
constexpr std::array<std::uint32_t, 3> NeckDepths{ 1, 2, 3 };
/// Fewer vertices beyond these are left over from a neck.
constexpr std::size_t LeastCore = 12;
/// The square of the length of all necks of a part is less than that many of its areas.
constexpr double MostSquaredNeck = 1.;
/// ... and that of the boundaries that speak for the turn is more.
constexpr double LeastSquaredContradiction = 0.25;
/// These are longer than so many of its necks.
constexpr double LeastPerNeck = 2.;
constexpr std::uint32_t NoPart = std::numeric_limits<std::uint32_t>::max();

/// Of two parts: the lengths that speak for their being turned against each other, less those against it.
using Links = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

class Parts
{
public:
  explicit Parts(Mesh& mesh)
    : mesh_(mesh)
    , pairs_(facingPairs(mesh))
    , depths_(mesh.indexEnd(), NoPart)
  {
    std::vector<VertexIndex> front;
    for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
    {
      if (mesh.isAlive(v) && mesh.isBoundary(v))
      {
        depths_[v] = 0;
        front.push_back(v);
      }
    }
    spread(front, depths_, [this](VertexIndex from) { return depths_[from] + 1; });
  }

  bool doContradict() const
  {
    return std::any_of(
      pairs_.begin(), pairs_.end(), [](const FacingPair& pair) { return pair.contradict; });
  }

  /// Returns how many parts were cut off, with necks of that depth.
  std::size_t cut(std::uint32_t depth)
  {
    findParts(depth);
    if (areas_.size() < 2)
    {
      return 0;
    }
    findLinks();
    turnParts();
    return removeNecks();
  }

private:
  /// From those that have a value to all that have none, by the fewest edges.
  template <typename Next>
  void spread(std::vector<VertexIndex>& front, std::vector<std::uint32_t>& values, Next next) const
  {
    for (std::size_t i = 0; i < front.size(); ++i)
    {
      for (const VertexIndex other : mesh_.ring(front[i]))
      {
        if (values[other] == NoPart)
        {
          values[other] = next(front[i]);
          front.push_back(other);
        }
      }
    }
  }

  void findParts(std::uint32_t depth)
  {
    parts_.assign(mesh_.indexEnd(), NoPart);
    std::vector<VertexIndex> cores, core;
    std::vector<std::uint8_t> isFound(mesh_.indexEnd(), 0);
    std::uint32_t count = 0;
    for (VertexIndex first = 0; first < mesh_.indexEnd(); ++first)
    {
      if (isFound[first] != 0 || !mesh_.isAlive(first) || depths_[first] < depth)
      {
        continue;
      }
      core.assign(1, first);
      isFound[first] = 1;
      for (std::size_t i = 0; i < core.size(); ++i)
      {
        for (const VertexIndex other : mesh_.ring(core[i]))
        {
          if (isFound[other] == 0 && depths_[other] >= depth)
          {
            isFound[other] = 1;
            core.push_back(other);
          }
        }
      }
      if (core.size() >= LeastCore)
      {
        for (const VertexIndex v : core)
        {
          parts_[v] = count;
        }
        cores.insert(cores.end(), core.begin(), core.end());
        ++count;
      }
    }
    spread(cores, parts_, [this](VertexIndex from) { return parts_[from]; });
    areas_.assign(count, 0.);
  }

  void findLinks()
  {
    necks_.clear();
    contradictions_.clear();
    mesh_.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        if (parts_[a] == NoPart)
        {
          return; // a piece without a core
        }
        const double area = areaOf(mesh_, { a, b, c }) / 3.;
        for (const auto& [from, to, across] :
          { std::array{ a, b, c }, std::array{ b, c, a }, std::array{ c, a, b } })
        {
          areas_[parts_[from]] += area;
          if (parts_[from] == parts_[to] && parts_[to] != parts_[across])
          {
            necks_[ordered(from, across)] +=
              0.5 * double(std::sqrt(squaredNorm(mesh_.position(to) - mesh_.position(from))));
          }
          else if (parts_[from] != parts_[to])
          {
            necks_[ordered(from, to)] += 0.;
          }
        }
      });
    for (const FacingPair& pair : pairs_)
    {
      const std::uint32_t one = parts_[pair.vertex], other = parts_[pair.other];
      if (one != other && one != NoPart && other != NoPart)
      {
        contradictions_[ordered(pair.vertex, pair.other)] +=
          pair.contradict ? pair.length : -pair.length;
      }
    }
  }

  std::pair<std::uint32_t, std::uint32_t> ordered(VertexIndex one, VertexIndex other) const
  {
    return std::minmax(parts_[one], parts_[other]);
  }

  /// What is most certain first: groups of parts are joined, with or against each other.
  void turnParts()
  {
    const std::size_t count = areas_.size();
    std::vector<std::map<std::uint32_t, double>> links(count);
    std::vector<std::vector<std::uint32_t>> groups(count);
    isTurned_.assign(count, false);
    const auto link = [&](const auto& ends, double value)
    {
      links[ends.first][ends.second] += value;
      links[ends.second][ends.first] += value;
    };
    for (std::uint32_t part = 0; part < count; ++part)
    {
      groups[part] = { part };
    }
    for (const auto& [ends, length] : necks_)
    {
      link(ends, -length);
    }
    for (const auto& [ends, length] : contradictions_)
    {
      link(ends, length);
    }
    for (;;)
    {
      std::uint32_t one = NoPart, other = NoPart;
      double most = 0.;
      for (std::uint32_t group = 0; group < count; ++group)
      {
        for (const auto& [to, value] : links[group])
        {
          if (group < to && std::abs(value) > most)
          {
            most = std::abs(value);
            one = group;
            other = to;
          }
        }
      }
      if (one == NoPart)
      {
        return;
      }
      const bool turns = links[one][other] > 0.;
      for (const std::uint32_t part : groups[other])
      {
        isTurned_[part] = isTurned_[part] != turns;
        groups[one].push_back(part);
      }
      for (const auto& [to, value] : links[other])
      {
        links[to].erase(other);
        if (to != one)
        {
          link(std::pair(one, to), turns ? -value : value);
        }
      }
      links[other].clear();
      groups[other].clear();
    }
  }

  /// Of all that hangs together and is turned alike.
  struct Side
  {
    double area = 0.;
    double neck = 0.;
    double contradiction = 0.;
    std::set<std::size_t> others;

    bool hangsByLittle() const
    {
      return neck * neck < MostSquaredNeck * area && contradiction > LeastPerNeck * neck &&
        contradiction * contradiction > LeastSquaredContradiction * area;
    }
  };

  std::size_t removeNecks()
  {
    DisjointSets sides(areas_.size());
    for (const auto& [ends, length] : necks_)
    {
      if (isTurned_[ends.first] == isTurned_[ends.second])
      {
        sides.join(ends.first, ends.second);
      }
    }
    std::map<std::size_t, Side> of;
    for (std::uint32_t part = 0; part < areas_.size(); ++part)
    {
      of[sides.root(part)].area += areas_[part];
    }
    const auto add = [&](const auto& ends, double Side::*sum, double length)
    {
      const std::size_t one = sides.root(ends.first), other = sides.root(ends.second);
      if (one != other && isTurned_[ends.first] != isTurned_[ends.second])
      {
        of[one].*sum += length;
        of[other].*sum += length;
      }
    };
    for (const auto& [ends, length] : necks_)
    {
      add(ends, &Side::neck, length);
      const std::size_t one = sides.root(ends.first), other = sides.root(ends.second);
      if (one != other)
      {
        of[one].others.insert(other);
        of[other].others.insert(one);
      }
    }
    for (const auto& [ends, length] : contradictions_)
    {
      add(ends, &Side::contradiction, length);
    }
    std::set<std::size_t> off;
    for (const auto& [root, side] : of)
    {
      const std::pair own(side.area, root);
      const bool isLess = !side.others.empty() &&
        std::all_of(side.others.begin(), side.others.end(),
          [&](std::size_t other) { return own < std::pair(of[other].area, other); });
      if (isLess && side.hangsByLittle())
      {
        off.insert(root);
      }
    }
    if (off.empty())
    {
      return 0;
    }
    const auto isOff = [&](VertexIndex v)
    { return parts_[v] != NoPart && off.count(sides.root(parts_[v])) > 0; };
    std::vector<Triangle> atNecks;
    mesh_.forEachTriangle(
      [&](VertexIndex a, VertexIndex b, VertexIndex c)
      {
        if (isOff(a) != isOff(b) || isOff(b) != isOff(c))
        {
          atNecks.push_back({ a, b, c });
        }
      });
    mesh_.removeTriangles(atNecks);
    std::vector<VertexIndex> turned;
    for (VertexIndex v = 0; v < mesh_.indexEnd(); ++v)
    {
      if (mesh_.isAlive(v) && isOff(v))
      {
        turned.push_back(v);
      }
    }
    mesh_.reverseOrientation(turned);
    return off.size();
  }

  Mesh& mesh_;
  std::vector<FacingPair> pairs_;
  std::vector<std::uint32_t> depths_; ///< in edges from the boundary
  std::vector<std::uint32_t> parts_;  ///< of the vertices
  std::vector<double> areas_;         ///< of the parts
  std::vector<bool> isTurned_;
  Links necks_;
  Links contradictions_;
};
}

std::size_t separateTwistedParts(Mesh& mesh)
{
  std::size_t count = 0;
  for (const std::uint32_t depth : NeckDepths)
  {
    Parts parts(mesh);
    if (!parts.doContradict())
    {
      break;
    }
    count += parts.cut(depth);
  }
  return count;
}
}
