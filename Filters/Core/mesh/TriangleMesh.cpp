// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

namespace neuralmesh
{
std::vector<Eigen::Vector3d> pointNormals(const TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3d> normals(mesh.points.size(), Eigen::Vector3d::Zero());
  for (const auto& [a, b, c] : mesh.triangles)
  {
    const Eigen::Vector3d& corner = mesh.points[a];
    const Eigen::Vector3d normal = (mesh.points[b] - corner).cross(mesh.points[c] - corner);
    normals[a] += normal;
    normals[b] += normal;
    normals[c] += normal;
  }
  for (Eigen::Vector3d& normal : normals)
  {
    normal.stableNormalize();
  }
  return normals;
}
}
