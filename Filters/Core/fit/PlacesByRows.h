// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// The vertices [begin, end) of a mesh.
struct VertexRows
{
  VertexIndex begin = 0;
  VertexIndex end = NoVertex;

  bool has(VertexIndex v) const { return v >= begin && v < end; }
};

/// Divides the vertices of a mesh into consecutive parts for the threads of an executor.
class RowParts
{
public:
  RowParts(std::size_t indexEnd, const Executor& executor)
    : indexEnd_(indexEnd)
  {
    constexpr std::size_t PartsPerThread = 8, FewestRows = 256;
    const std::size_t threads = executor.threadCount();
    if (threads > 1)
    {
      const std::size_t rows = std::max(FewestRows, indexEnd / (PartsPerThread * threads));
      shift_ = std::countr_zero(std::bit_ceil(rows));
    }
  }

  /// Parts that depend on the number of vertices alone.
  static RowParts byWork(std::size_t indexEnd)
  {
    constexpr std::size_t FewestRows = 4096, MostParts = 64;
    RowParts parts(indexEnd, Executor::sequential());
    parts.shift_ = std::countr_zero(std::bit_ceil(std::max(FewestRows, indexEnd / MostParts)));
    return parts;
  }

  std::size_t count() const
  {
    return std::max<std::size_t>(1, (indexEnd_ + (std::uint64_t(1) << shift_) - 1) >> shift_);
  }
  std::size_t of(VertexIndex v) const { return std::uint64_t(v) >> shift_; }
  VertexRows rows(std::size_t part) const
  {
    return { VertexIndex(std::min<std::size_t>(indexEnd_, part << shift_)),
      VertexIndex(std::min<std::size_t>(indexEnd_, (part + 1) << shift_)) };
  }

private:
  std::size_t indexEnd_;
  int shift_ = 32;
};

/// Calls `body(rows, i)` for each used place and each part of the vertices that has one of its
/// corners, in the order of the places. So sums at the vertices of `rows` are the same to the last
/// bit on any number of threads. `isUsed(i)` says whether a place is used. An executor may interrupt it between ranges of
/// the places, also on one thread.
template <typename IsUsed, typename Body>
void forEachPlaceByRows(std::span<const PlaceOnMesh> places, const RowParts& parts,
  const Executor& executor, const IsUsed& isUsed, const Body& body)
{
  constexpr std::size_t PlacesPerRange = 16384;
  const std::size_t ranges = (places.size() + PlacesPerRange - 1) / PlacesPerRange;
  if (parts.count() == 1 || executor.threadCount() == 1)
  {
    const VertexRows all;
    for (std::size_t range = 0; range < ranges; ++range)
    {
      executor.forEachPart(1,
        [&](std::size_t)
        {
          const std::size_t end = std::min(places.size(), (range + 1) * PlacesPerRange);
          for (std::size_t i = range * PlacesPerRange; i < end; ++i)
          {
            if (isUsed(i))
            {
              body(all, i);
            }
          }
        });
    }
    return;
  }
  // Of each range of the places, those that lie in each part: runs, as places that follow each other are mostly near.
  struct Run
  {
    std::uint32_t begin, end;
  };
  std::vector<std::vector<Run>> runsOf(ranges * parts.count());
  executor.forEachRange(places.size(), PlacesPerRange,
    [&](std::size_t begin, std::size_t end)
    {
      const auto runs =
        std::span(runsOf).subspan(begin / PlacesPerRange * parts.count(), parts.count());
      for (auto i = std::uint32_t(begin); i < end; ++i)
      {
        if (!isUsed(i))
        {
          continue;
        }
        const auto addTo = [i](std::vector<Run>& ofPart)
        {
          if (ofPart.empty() || ofPart.back().end < i)
          {
            ofPart.push_back({ i, i });
          }
          ofPart.back().end = i + 1;
        };
        const Triangle& corners = places[i].triangle;
        const std::array<std::size_t, 3> partsOf{ parts.of(corners[0]), parts.of(corners[1]),
          parts.of(corners[2]) };
        addTo(runs[partsOf[0]]);
        if (partsOf[1] != partsOf[0] || partsOf[2] != partsOf[0])
        {
          addTo(runs[partsOf[1]]);
          addTo(runs[partsOf[2]]);
        }
      }
    });
  executor.forEachPart(parts.count(),
    [&](std::size_t part)
    {
      const VertexRows rows = parts.rows(part);
      for (std::size_t range = 0; range < ranges; ++range)
      {
        for (const Run run : runsOf[range * parts.count() + part])
        {
          for (std::uint32_t i = run.begin; i < run.end; ++i)
          {
            body(rows, i);
          }
        }
      }
    });
}
}
