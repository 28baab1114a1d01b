// SPDX-License-Identifier: BSD-3-Clause
// Promise: corners are completed, fillets are left alone.
#include "fit/CutCorners.h"

#include "base/Random.h"
#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "PlacedCloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace neuralmesh::testing
{
namespace
{
/// Two planes, 2 wide and up to 1 long, that a fillet joins, in so many quadrangles. Corners of these lie off by up to that
/// part of them.
TriangleMesh roofWithFillet(
  double radius, unsigned across, unsigned along, double part = 0., std::uint64_t seed = 0)
{
  const double plane = 1. - radius, arc = 0.5 * std::numbers::pi * radius;
  const double length = 2. * plane + arc;
  const auto at = [&](double way)
  {
    const double angle = std::clamp((way - plane) / radius, 0., 0.5 * std::numbers::pi);
    return Eigen::Vector2d(-radius + radius * std::sin(angle) + std::min(way - plane, 0.),
      radius * std::cos(angle) - std::max(way - plane - arc, 0.));
  };
  Random random(seed);
  const auto off = [&](unsigned i, unsigned end)
  { return i > 0 && i < end ? part * (2. * random.uniform() - 1.) : 0.; };
  TriangleMesh roof;
  for (unsigned j = 0; j <= along; ++j)
  {
    for (unsigned i = 0; i <= across; ++i)
    {
      const Eigen::Vector2d place = at(length * (i + off(i, across)) / across);
      roof.points.emplace_back(place.x(), 2. * (j + off(j, along)) / along, place.y());
    }
  }
  for (unsigned j = 0; j < along; ++j)
  {
    for (unsigned i = 0; i < across; ++i)
    {
      const std::uint32_t a = j * (across + 1) + i, b = a + across + 1;
      roof.triangles.push_back({ a, a + 1, b + 1 });
      roof.triangles.push_back({ a, b + 1, b });
    }
  }
  return roof;
}
}

// A fillet of two edges' length is no corner that was cut off: next to no vertex goes where its planes would meet.
TEST(CutCorners, LeaveFillets)
{
  constexpr double Radius = 0.2, PartOff = 0.2;
  constexpr unsigned Edges = 20;
  const TriangleMesh truth = roofWithFillet(Radius, 400, 1);
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 120; ++seed)
  {
    for (const std::size_t count : { 2000u, 3000u, 4500u })
    {
      CloudOptions options;
      options.count = count;
      options.seed = seed;
      const PointCloud cloud(generateCloud(truth, options));
      Mesh mesh = buildMesh(roofWithFillet(Radius, Edges, Edges, PartOff, seed), cloud);
      const PlacedCloud placed(cloud, mesh);
      moved += completeCorners(mesh, placed.samples, 0.).any ? 1 : 0;
    }
  }
  EXPECT_LT(moved, 11);
}
}
