// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/MeshOrientation.h"

#include "base/Random.h"
#include "cloud/MeshBuilder.h"
#include "MeshTools.h"
#include "OpenShapes.h"
#include "Shapes.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

inline TriangleMesh turned(TriangleMesh mesh)
{
  for (auto& [a, b, c] : mesh.triangles)
  {
    std::swap(b, c);
  }
  return mesh;
}

inline TriangleMesh placed(
  TriangleMesh mesh, const Eigen::Matrix3d& turn, const Eigen::Vector3d& shift, double scale = 1.)
{
  for (Eigen::Vector3d& point : mesh.points)
  {
    point = scale * (turn * point) + shift;
  }
  return mesh;
}

/// What looks up looks against y then.
inline Eigen::Matrix3d upright()
{
  return Eigen::AngleAxisd(std::numbers::pi / 2., Eigen::Vector3d::UnitX()).toRotationMatrix();
}

/// Those triangles whose centroid is kept.
template <typename Condition>
inline TriangleMesh partOf(const TriangleMesh& mesh, Condition isKept)
{
  TriangleMesh part{ mesh.points, {} };
  for (const auto& [a, b, c] : mesh.triangles)
  {
    if (isKept(Eigen::Vector3d((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.)))
    {
      part.triangles.push_back({ a, b, c });
    }
  }
  return part;
}

/// The sphere without what is within an angle of its south pole.
inline TriangleMesh openSphere(double degrees)
{
  const double lowest = -std::cos(degrees * std::numbers::pi / 180.);
  return partOf(makeSphere(24),
    [lowest](const Eigen::Vector3d& centroid) { return centroid.normalized().z() > lowest; });
}

/// A mesh over a cloud of its own points.
struct Scene
{
  explicit Scene(const TriangleMesh& triangles)
    : surface(triangles)
    , cloud(surface.points, {}, true)
    , mesh(buildMesh(triangles, cloud))
  {
  }

  OrientationReport orient(const OrientationHints& hints = {})
  {
    return orientMesh(mesh, cloud, hints);
  }

  /// The part of the triangles of which `looksAt(centroid)` is in front.
  template <typename Direction>
  double facing(Direction directionAt) const
  {
    const TriangleMesh result = trianglesOf(mesh, cloud);
    double count = 0.;
    for (const auto& [a, b, c] : result.triangles)
    {
      const Eigen::Vector3d &p = result.points[a], &q = result.points[b], &r = result.points[c];
      const Eigen::Vector3d direction = directionAt(Eigen::Vector3d((p + q + r) / 3.));
      count += (q - p).cross(r - p).dot(direction) > 0. ? 1. : 0.;
    }
    return count / double(result.triangles.size());
  }
  double facingOutwards() const
  {
    return facing([](const Eigen::Vector3d& centroid) { return centroid; });
  }
  double facingUp() const
  {
    return facing([](const Eigen::Vector3d&) { return Eigen::Vector3d::UnitZ(); });
  }

  TriangleMesh surface;
  PointCloud cloud;
  Mesh mesh;
};

inline OrientationHints up(const Eigen::Vector3d& direction = Eigen::Vector3d::UnitZ())
{
  return { {}, {}, {}, direction };
}

inline OrientationHints seenFrom(std::vector<Eigen::Vector3d> viewpoints)
{
  return { std::move(viewpoints), {}, {}, {} };
}

inline OrientationHints withNormals(std::function<Eigen::Vector3d(std::uint32_t)> normalOf)
{
  return { {}, {}, std::move(normalOf), {} };
}

inline Eigen::Vector3d randomDirection(Random& random) { return randomPoint(random).toDouble(); }

/// Islands of one sheet, each second one turned: 0.8 wide, and 0.2 apart from each other.
inline TriangleMesh islands(unsigned side)
{
  TriangleMesh all;
  for (unsigned i = 0; i < side * side; ++i)
  {
    const TriangleMesh island = placed(
      makeGrid(6), Eigen::Matrix3d::Identity(), { double(i % side), double(i / side), 0. }, 0.8);
    append(all, i % 2 == 0 ? island : turned(island));
  }
  return all;
}
}
