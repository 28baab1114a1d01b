// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/MeshBuilder.h"
#include "cloud/PlaceOnMesh.h"
#include "cloud/PointCloud.h"
#include "fit/TriangleSamples.h"
#include "mesh/Mesh.h"

#include <cstdint>
#include <vector>

namespace neuralmesh::testing
{
/// All points of a cloud, with their places on a mesh.
struct PlacedCloud
{
  PlacedCloud(const PointCloud& cloud, const Mesh& mesh)
    : isUsed(cloud.points().size(), 1)
  {
    const VertexGrid grid = gridOf(mesh, cloud);
    for (const Vector4& point : cloud.points())
    {
      places.push_back(closestPlaceAround(point, mesh, grid.closest(point, mesh.positions())));
    }
    samples = { cloud.points(), places, isUsed, {} };
  }

  std::vector<PlaceOnMesh> places;
  std::vector<std::uint8_t> isUsed;
  PlacedSamples samples;
};
}
