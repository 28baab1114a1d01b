// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/CloudGenerator.h"
#include "cloud/MeshBuilder.h"
#include "cloud/PointCloud.h"
#include "learn/Parameters.h"
#include "Shapes.h"

#include <cmath>
#include <numbers>

namespace neuralmesh::testing
{
inline const double SphereDiagonal = 2. * std::sqrt(3.);
constexpr double SphereVolume = 4. / 3. * std::numbers::pi;

inline std::vector<Eigen::Vector3d> sphereCloud(CloudOptions options = {})
{
  options.count = options.count == CloudOptions().count ? 40000 : options.count;
  return generateCloud(makeSphere(), options);
}

inline const PointCloud& cleanSphere()
{
  static const PointCloud cloud(sphereCloud());
  return cloud;
}

/// In the coordinates of that sphere.
inline Mesh meshOf(const TriangleMesh& triangles) { return buildMesh(triangles, cleanSphere()); }

/// For runs that nobody cancels.
inline bool goOn(double) { return true; }

/// The defaults, but from a tetrahedron, and without a finish.
inline Parameters learningAlone()
{
  Parameters parameters;
  parameters.start = Start::Tetrahedron;
  parameters.fitRounds = 0;
  return parameters;
}

inline Parameters small()
{
  Parameters parameters;
  parameters.numberOfVertices = 500;
  return parameters;
}
}
