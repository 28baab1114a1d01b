// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Orientation.h"

#include <Eigen/Geometry>

namespace neuralmesh
{
namespace
{
/// Six times the signed volume, with the first vertex as the origin, for precision.
double signedVolume(const Mesh& mesh, std::span<const VertexIndex> component)
{
  const Eigen::Vector3d origin = mesh.position(component.front()).toDouble();
  double volume = 0.;
  for (const VertexIndex v : component)
  {
    const Ring& ring = mesh.ring(v);
    const Eigen::Vector3d a = mesh.position(v).toDouble() - origin;
    for (unsigned slot = 0; slot < ring.triangleCount(); ++slot)
    {
      // Every triangle is seen from its three corners.
      const Eigen::Vector3d b = mesh.position(ring[slot]).toDouble() - origin;
      const Eigen::Vector3d c = mesh.position(ring[ring.after(slot)]).toDouble() - origin;
      volume += a.dot(b.cross(c)) / 3.;
    }
  }
  return volume;
}
}

std::size_t orientOutwards(Mesh& mesh)
{
  std::size_t turned = 0;
  std::vector<bool> visited(mesh.indexEnd(), false);
  std::vector<VertexIndex> component;
  for (VertexIndex seed = 0; seed < mesh.indexEnd(); ++seed)
  {
    if (visited[seed] || !mesh.isAlive(seed))
    {
      continue;
    }
    bool closed = true;
    visited[seed] = true;
    component.assign(1, seed);
    for (std::size_t i = 0; i < component.size(); ++i)
    {
      const Ring& ring = mesh.ring(component[i]);
      closed = closed && !ring.isOpen();
      for (const VertexIndex neighbor : ring)
      {
        if (!visited[neighbor])
        {
          visited[neighbor] = true;
          component.push_back(neighbor);
        }
      }
    }
    if (closed && signedVolume(mesh, component) < 0.)
    {
      mesh.reverseOrientation(component);
      ++turned;
    }
  }
  return turned;
}
}
