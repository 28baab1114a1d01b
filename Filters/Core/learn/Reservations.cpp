// SPDX-License-Identifier: BSD-3-Clause
#include "learn/Reservations.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace neuralmesh
{
namespace
{
constexpr std::size_t RequestsPerPart = 64;
constexpr std::size_t HoldersPerPart = 1 << 14;

auto atomicAt(std::uint64_t& holder) { return std::atomic_ref(holder); }
}

/// Returns false if there are too many.
bool Reservations::Reach::collect(const Mesh& mesh, VertexIndex v)
{
  count = 0;
  const auto add = [this](VertexIndex u)
  {
    if (count == Most)
    {
      return false;
    }
    vertices[count++] = u;
    return true;
  };
  const Ring& ring = mesh.ring(v);
  bool isComplete = add(v);
  for (unsigned slot = 0; slot < ring.size() && isComplete; ++slot)
  {
    isComplete = add(ring[slot]);
    for (const VertexIndex far : mesh.ring(ring[slot]))
    {
      const bool isNear =
        far == v || far == ring[ring.after(slot)] || far == ring[ring.before(slot)];
      isComplete = isComplete && (isNear || add(far));
    }
  }
  return isComplete;
}

std::span<const std::uint8_t> Reservations::decide(
  const Mesh& mesh, std::span<const Request> requests, const Executor& executor)
{
  holders_.resize(mesh.indexEnd());
  executor.forEachRange(holders_.size(), HoldersPerPart,
    [this](std::size_t begin, std::size_t end)
    { std::fill(holders_.begin() + long(begin), holders_.begin() + long(end), 0); });
  const std::size_t count = requests.size();
  if (reaches_.size() < count)
  {
    reaches_ = {};
    reaches_ = ZeroedArray<Reach>(count + count / 2);
  }
  isGranted_.assign(count, 0);
  isDecided_.assign(count, 0);
  undecided_.resize(count);
  std::iota(undecided_.begin(), undecided_.end(), 0u);
  for (bool isFirst = true; !undecided_.empty(); isFirst = false)
  {
    const auto forEachUndecided = [&](const auto& body)
    {
      executor.forEachRange(undecided_.size(), RequestsPerPart,
        [&](std::size_t begin, std::size_t end)
        {
          for (std::size_t i = begin; i < end; ++i)
          {
            body(undecided_[i]);
          }
        });
    };
    forEachUndecided(
      [&](std::uint32_t i)
      {
        const bool isKnown = !isFirst || reaches_[i].collect(mesh, requests[i].vertex);
        isDecided_[i] = isKnown && claim(i, requests[i].key) ? 0 : 1;
      });
    // Who sees that another has got, or left, what it wants had the lower key there anyway: so it does
    // not matter who comes first.
    forEachUndecided(
      [&](std::uint32_t i)
      {
        if (isDecided_[i] == 0)
        {
          settle(i, requests[i].key);
        }
      });
    std::erase_if(undecided_, [this](std::uint32_t i) { return isDecided_[i] != 0; });
  }
  return isGranted_;
}

/// Leaves the key wherever it is the highest. Returns false if some of the vertices are taken.
bool Reservations::claim(std::size_t request, std::uint64_t key)
{
  const std::span<const VertexIndex> reach = reaches_[request].all();
  if (std::any_of(reach.begin(), reach.end(),
        [this](VertexIndex u)
        { return atomicAt(holders_[u]).load(std::memory_order_relaxed) >= Granted; }))
  {
    return false;
  }
  for (const VertexIndex u : reach)
  {
    std::uint64_t other = atomicAt(holders_[u]).load(std::memory_order_relaxed);
    while (other < key &&
      !atomicAt(holders_[u]).compare_exchange_weak(other, key, std::memory_order_relaxed))
    {
    }
  }
  return true;
}

/// Takes all of the vertices if the key is the highest everywhere; else leaves them to others.
void Reservations::settle(std::size_t request, std::uint64_t key)
{
  const std::span<const VertexIndex> reach = reaches_[request].all();
  const bool isGranted = std::all_of(reach.begin(), reach.end(),
    [&](VertexIndex u) { return atomicAt(holders_[u]).load(std::memory_order_relaxed) == key; });
  for (const VertexIndex u : reach)
  {
    std::uint64_t own = key;
    atomicAt(holders_[u])
      .compare_exchange_strong(own, isGranted ? key | Granted : 0, std::memory_order_relaxed);
  }
  isGranted_[request] = isGranted ? 1 : 0;
  isDecided_[request] = isGranted ? 1 : 0;
}
}
