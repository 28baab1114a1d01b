// SPDX-License-Identifier: BSD-3-Clause
// Promise: numbers of points arrive at the vertices as they are at their places, within their range, however many
// components they have and in whatever unit.
#include "cloud/AttributeNumbers.h"

#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace neuralmesh::testing
{
namespace
{
constexpr std::size_t Components = 6;

/// A sphere of points that know where they come from.
struct NumberedSphere
{
  std::vector<Eigen::Vector3d> points = sphereCloud();
  PointCloud cloud{ points, {}, true };
  Mesh mesh = buildMesh(makeSphere(16), cloud);
  CloudPlaces places{ cloud, mesh, goOn };

  /// The place of a point in units and with offsets that differ.
  std::vector<double> carried(double bad = 0.) const
  {
    return carryNumbers(places, Components,
      [&](std::uint32_t point, std::span<double> tuple)
      {
        for (std::size_t i = 0; i < Components; ++i)
        {
          tuple[i] = numberAt(points[point], i);
        }
        tuple[5] += points[point].x() > 0.9 ? bad : 0.;
      });
  }
  static double numberAt(const Eigen::Vector3d& place, std::size_t component)
  {
    return std::pow(1e6, double(component) - 2.) * (place[Eigen::Index(component % 3)] + 5.);
  }
};
}

// A linear field comes out as it is, to a tenth of an edge or so, in all components.
TEST(AttributeNumbers, LinearField)
{
  const NumberedSphere sphere;
  const std::vector<double> numbers = sphere.carried();
  ASSERT_EQ(numbers.size(), Components * sphere.mesh.indexEnd());
  for (VertexIndex v = 0; v < sphere.mesh.indexEnd(); ++v)
  {
    const Eigen::Vector3d place = sphere.cloud.toInput(sphere.mesh.position(v));
    for (std::size_t i = 0; i < Components; ++i)
    {
      const double unit = std::pow(1e6, double(i) - 2.);
      EXPECT_NEAR(
        numbers[v * Components + i] / unit, NumberedSphere::numberAt(place, i) / unit, 0.01);
      EXPECT_GE(numbers[v * Components + i] / unit, 4. - 1e-9);
      EXPECT_LE(numbers[v * Components + i] / unit, 6. + 1e-9);
    }
  }
}

// Points with a number that is not finite do not count: where all are such, the mesh has none, and elsewhere
// nothing is lost.
TEST(AttributeNumbers, NotFinite)
{
  const NumberedSphere sphere;
  const std::vector<double> numbers = sphere.carried(std::numeric_limits<double>::quiet_NaN());
  for (VertexIndex v = 0; v < sphere.mesh.indexEnd(); ++v)
  {
    const double x = sphere.cloud.toInput(sphere.mesh.position(v)).x();
    const bool isKnown = std::isfinite(numbers[v * Components]);
    EXPECT_TRUE(x > 0.85 || isKnown);
    EXPECT_TRUE(x < 0.99 || !isKnown);
  }
  const std::vector<double> none = carryNumbers(sphere.places, 1,
    [](std::uint32_t, std::span<double> tuple)
    { tuple[0] = std::numeric_limits<double>::infinity(); });
  ASSERT_EQ(none.size(), sphere.mesh.indexEnd());
  for (const double number : none)
  {
    EXPECT_TRUE(std::isnan(number));
  }
}
}
