// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NarrowStrips.h"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>

namespace neuralmesh
{
namespace
{
/// Vertices of a strip through which narrow loops lead.
constexpr std::size_t LeastInStrip = 3;
/// For the executor.
constexpr std::size_t VerticesOfStripPart = 4096;
constexpr std::size_t MostSurroundings = 32;

/// The vertices that lie within some edges of one.
class Surroundings
{
public:
  Surroundings(const Mesh& mesh, int longestLoop)
    : mesh_(mesh)
    , ringsOfLoop_(longestLoop / 2)
    , lastCenter_(mesh.indexEnd(), NoVertex)
  {
  }

  /// Whether they lie around `center` as on a strip that runs back into itself, and not as on a disk. (So
  /// they do, too, where they enclose a vertex that is farther away.)
  bool closeUp(VertexIndex center)
  {
    const std::size_t withNeighbors = collect(center);
    // Each vertex has a part of the Euler characteristic: half of its edges, and a third of its triangles. Of one with all
    // its neighbours that is a sixth of what its valence lacks.
    long sixths = 0;
    for (std::size_t i = 0; i < around_.size(); ++i)
    {
      sixths +=
        i < withNeighbors ? -mesh_.valenceExcess(around_[i]) : sixthsAtRim(around_[i], center);
    }
    return sixths < 6;
  }

  /// How many lie within some edges of a strip on that side of it where they are fewer. Where both sides hang
  /// together it is half of them.
  std::size_t countOnSmallerSide(const NarrowStrip& strip)
  {
    around_ = strip;
    for (const VertexIndex v : strip)
    {
      lastCenter_[v] = strip[0];
    }
    spread(strip[0], RingsAround);
    const std::vector<VertexIndex> beyond(around_.begin() + long(strip.size()), around_.end());
    for (const VertexIndex v : strip)
    {
      lastCenter_[v] = NoVertex;
    }
    std::array<std::size_t, 2> largest{};
    for (const VertexIndex first : beyond)
    {
      if (lastCenter_[first] == strip[0])
      {
        const std::size_t side = takeSide(first, strip[0]);
        largest = { std::max(largest[0], side), std::max(largest[1], std::min(largest[0], side)) };
      }
    }
    return largest[1] > 0 ? largest[1] : largest[0] / 2;
  }

private:
  /// Returns how many have all their neighbours with them. These come first.
  std::size_t collect(VertexIndex center)
  {
    around_.assign(1, center);
    lastCenter_[center] = center;
    return spread(center, ringsOfLoop_);
  }

  std::size_t spread(VertexIndex center, int rings)
  {
    std::size_t next = 0;
    for (int ring = 0; ring < rings; ++ring)
    {
      for (const std::size_t end = around_.size(); next < end; ++next)
      {
        for (const VertexIndex neighbor : mesh_.ring(around_[next]))
        {
          if (lastCenter_[neighbor] != center)
          {
            lastCenter_[neighbor] = center;
            around_.push_back(neighbor);
          }
        }
      }
    }
    return next;
  }

  /// The part of the Euler characteristic at a vertex of which some neighbours may not be around `center`.
  int sixthsAtRim(VertexIndex v, VertexIndex center) const
  {
    const Ring& ring = mesh_.ring(v);
    const auto isAround = [&](VertexIndex neighbor) { return lastCenter_[neighbor] == center; };
    int sixths = 6;
    bool wasAround = !ring.isOpen() && isAround(ring.back());
    for (const VertexIndex neighbor : ring)
    {
      const bool isNow = isAround(neighbor);
      sixths += (isNow && wasAround ? 2 : 0) - (isNow ? 3 : 0);
      wasAround = isNow;
    }
    return sixths;
  }

  /// How many of those around `center` hang together with one of them, which are then not around it any more.
  std::size_t takeSide(VertexIndex first, VertexIndex center)
  {
    around_.assign(1, first);
    lastCenter_[first] = NoVertex;
    for (std::size_t next = 0; next < around_.size(); ++next)
    {
      for (const VertexIndex neighbor : mesh_.ring(around_[next]))
      {
        if (lastCenter_[neighbor] == center)
        {
          lastCenter_[neighbor] = NoVertex;
          around_.push_back(neighbor);
        }
      }
    }
    return around_.size();
  }

  const Mesh& mesh_;
  int ringsOfLoop_;                     ///< a loop through a vertex lies within so many edges of it
  std::vector<VertexIndex> lastCenter_; ///< of each vertex, the last one that it was around
  std::vector<VertexIndex> around_;
};

/// What was seen takes memory, and does not matter to another vertex: so threads use a few of them again.
class SurroundingsToShare
{
public:
  SurroundingsToShare(const Mesh& mesh, int longestLoop)
    : mesh_(mesh)
    , longestLoop_(longestLoop)
  {
    idle_.reserve(MostSurroundings);
  }

  /// Waits for one, and gives it back.
  class Loan
  {
  public:
    explicit Loan(SurroundingsToShare& shared)
      : shared_(shared)
    {
      std::unique_lock lock(shared_.mutex_);
      shared_.isFree_.wait(
        lock, [&] { return !shared_.idle_.empty() || shared_.count_ < MostSurroundings; });
      if (!shared_.idle_.empty())
      {
        lent_ = std::move(shared_.idle_.back());
        shared_.idle_.pop_back();
        return;
      }
      lent_ = std::make_unique<Surroundings>(shared_.mesh_, shared_.longestLoop_);
      ++shared_.count_;
    }
    ~Loan()
    {
      const std::lock_guard lock(shared_.mutex_);
      shared_.idle_.push_back(std::move(lent_));
      shared_.isFree_.notify_one();
    }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    Surroundings* operator->() const { return lent_.get(); }

  private:
    SurroundingsToShare& shared_;
    std::unique_ptr<Surroundings> lent_;
  };

private:
  const Mesh& mesh_;
  int longestLoop_;
  std::mutex mutex_;
  std::condition_variable isFree_;
  std::vector<std::unique_ptr<Surroundings>> idle_;
  std::size_t count_ = 0;
};
}

std::vector<NarrowStrip> findNarrowStrips(const Mesh& mesh, const Executor& executor,
  const StripLimits& limits, std::span<const std::uint8_t> isCandidate)
{
  std::vector<std::uint8_t> isOpen(mesh.indexEnd(), 0);
  SurroundingsToShare shared(mesh, limits.longestLoop);
  executor.forEachRange(mesh.indexEnd(), VerticesOfStripPart,
    [&](std::size_t begin, std::size_t end)
    {
      const SurroundingsToShare::Loan loan(shared);
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        isOpen[v] = (isCandidate.empty() || isCandidate[v] != 0) && loan->closeUp(v) ? 1 : 0;
      }
    });
  std::vector<NarrowStrip> strips;
  for (VertexIndex first = 0; first < mesh.indexEnd(); ++first)
  {
    if (isOpen[first] == 0)
    {
      continue;
    }
    isOpen[first] = 0;
    NarrowStrip strip{ first };
    for (std::size_t i = 0; i < strip.size(); ++i)
    {
      for (const VertexIndex neighbor : mesh.ring(strip[i]))
      {
        if (isOpen[neighbor] != 0)
        {
          isOpen[neighbor] = 0;
          strip.push_back(neighbor);
        }
      }
    }
    if (strip.size() >= LeastInStrip && strip.size() <= limits.mostVertices)
    {
      strips.push_back(std::move(strip));
    }
  }
  // What was seen around vertices is not to count.
  Surroundings aroundStrips(mesh, limits.longestLoop);
  std::erase_if(strips,
    [&](const NarrowStrip& strip)
    { return aroundStrips.countOnSmallerSide(strip) < limits.leastOnEachSide; });
  std::stable_sort(strips.begin(), strips.end(),
    [](const NarrowStrip& a, const NarrowStrip& b) { return a.size() > b.size(); });
  return strips;
}

void cutStrip(Mesh& mesh, const NarrowStrip& strip)
{
  std::vector<Triangle> triangles;
  for (const VertexIndex v : strip)
  {
    const Ring& ring = mesh.ring(v);
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      triangles.push_back({ v, ring[slot], ring[ring.after(slot)] });
    }
  }
  mesh.removeTriangles(triangles);
}
}
