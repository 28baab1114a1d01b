// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "base/ThreadPool.h"
#include "learn/Reservations.h"
#include "OpenShapes.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

namespace neuralmesh::testing
{
namespace
{
std::set<VertexIndex> twoRings(const Mesh& mesh, VertexIndex v)
{
  std::set<VertexIndex> result{ v };
  for (const VertexIndex neighbor : mesh.ring(v))
  {
    result.insert(neighbor);
    result.insert(mesh.ring(neighbor).begin(), mesh.ring(neighbor).end());
  }
  return result;
}

std::vector<Reservations::Request> manyRequests(const Mesh& mesh)
{
  std::vector<Reservations::Request> requests;
  Random random(3);
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (random.uniform() < 0.4)
    {
      requests.push_back({ v, (random.next() >> 20 << 16 | v) + 1 });
    }
  }
  return requests;
}

/// The most urgent one first, each if nobody before it has some of its vertices.
std::vector<std::uint8_t> oneAfterTheOther(
  const Mesh& mesh, const std::vector<Reservations::Request>& requests)
{
  std::vector<std::size_t> order(requests.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return requests[a].key > requests[b].key; });
  std::vector<std::uint8_t> granted(requests.size());
  std::set<VertexIndex> taken;
  for (const std::size_t i : order)
  {
    const std::set<VertexIndex> reach = twoRings(mesh, requests[i].vertex);
    if (std::none_of(reach.begin(), reach.end(), [&](VertexIndex v) { return taken.count(v) > 0; }))
    {
      granted[i] = 1;
      taken.insert(reach.begin(), reach.end());
    }
  }
  return granted;
}
}

// Who gets what it asks for is as if one were asked after the other, on any number of threads; and all of it is then
// held by that one alone.
TEST(Reservations, AreThoseOfOneAfterTheOther)
{
  for (const Mesh& mesh : { meshOf(makeSphere(24)), meshOf(makeGrid(40)) })
  {
    const std::vector<Reservations::Request> requests = manyRequests(mesh);
    const std::vector<std::uint8_t> expected = oneAfterTheOther(mesh, requests);
    ASSERT_GT(std::accumulate(expected.begin(), expected.end(), 0), 10);
    for (const unsigned threads : { 1u, 2u, 7u })
    {
      Reservations reservations;
      const auto granted = reservations.decide(mesh, requests, ThreadPool(threads));
      ASSERT_TRUE(std::equal(granted.begin(), granted.end(), expected.begin(), expected.end()));
      for (std::size_t i = 0; i < requests.size(); ++i)
      {
        for (const VertexIndex v : twoRings(mesh, requests[i].vertex))
        {
          const bool isHeld = reservations.holders()[v] == Reservations::heldBy(requests[i]);
          ASSERT_TRUE(granted[i] == 0 || isHeld);
        }
      }
    }
  }
}
}
