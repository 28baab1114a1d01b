// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/LargePageAllocator.h"
#include "base/ZeroedArray.h"
#include "mesh/Mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Tells of many operations, each at a vertex, which of them may be made at the same time: those that have the two
/// rings around their vertices for themselves. The most urgent ones go first, as if one were asked after the other;
/// but all of them are asked at once, in rounds (deterministic reservations: Blelloch, Fineman, Gibbons and Shun,
/// 2012): so the answer does not depend on threads.
class Reservations
{
public:
  /// The keys of an operation: the higher, the more urgent. No two are equal, and none is above this.
  static constexpr std::uint64_t HighestKey = (std::uint64_t(1) << 63) - 1;

  struct Request
  {
    VertexIndex vertex = NoVertex;
    std::uint64_t key = 0;
  };

  /// For each request whether it is granted.
  std::span<const std::uint8_t> decide(
    const Mesh& mesh, std::span<const Request> requests, const Executor& executor);

  /// Afterwards: what holds each vertex, and what it holds if a request is granted.
  std::span<const std::uint64_t> holders() const { return holders_; }
  static std::uint64_t heldBy(const Request& request) { return request.key | Granted; }
  /// A new vertex belongs to the operation that has made it.
  void give(VertexIndex added, const Request& request) { holders_[added] = heldBy(request); }
  void resize(std::size_t indexEnd) { holders_.resize(indexEnd, 0); }

private:
  static constexpr std::uint64_t Granted = std::uint64_t(1) << 63;

  /// The two rings around a vertex, some of them more than once.
  struct Reach
  {
    static constexpr std::uint32_t Most = 95;

    std::uint32_t count = 0;
    std::array<VertexIndex, Most> vertices;

    std::span<const VertexIndex> all() const { return std::span(vertices).first(count); }
    bool collect(const Mesh& mesh, VertexIndex v);
  };

  bool claim(std::size_t request, std::uint64_t key);
  void settle(std::size_t request, std::uint64_t key);

  LargeVector<std::uint64_t> holders_; ///< of each vertex: the highest key that wants it; 0: none
  ZeroedArray<Reach> reaches_;
  std::vector<std::uint8_t> isGranted_;
  std::vector<std::uint8_t> isDecided_;
  std::vector<std::uint32_t> undecided_;
};
}
