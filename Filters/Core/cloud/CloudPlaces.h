// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace neuralmesh
{
/// Where each point of a cloud lies on a mesh: at the closest place. 16 bytes a point.
class CloudPlaces
{
public:
  /// A corner of the triangle on which a point lies, and its barycentric weight.
  struct Corner
  {
    VertexIndex vertex;
    double weight;
  };
  using Corners = std::array<Corner, 3>;

  /// No vertex of the mesh may be erased. If it is ended early, all points are as
  /// outliers.
  CloudPlaces(const PointCloud& cloud, const Mesh& mesh, const Progress& progress,
    const Executor& executor = Executor::sequential());

  const PointCloud& cloud() const { return cloud_; }
  const Mesh& mesh() const { return mesh_; }

  /// Calls `use(point, corners)` for every point that is no outlier, by its index in the cloud.
  template <typename Use>
  void forEach(Use use) const
  {
    for (std::size_t i = 0; i < places_.size(); ++i)
    {
      const Place& place = places_[i];
      if (place.vertex != NoVertex)
      {
        use(i, cornersOf(place));
      }
    }
  }

  /// For each vertex the nearest corner of triangles on which points lie; NoVertex if there is none
  /// in its component.
  std::vector<VertexIndex> nearestSupported() const;

private:
  /// On a triangle of `vertex`: that in a slot of its ring, b towards the neighbour there and c
  /// towards the one after it.
  struct Place
  {
    VertexIndex vertex = NoVertex;
    std::uint32_t slot = 0;
    float b = 0.f;
    float c = 0.f;
  };
  Corners cornersOf(const Place& place) const;

  const PointCloud& cloud_;
  const Mesh& mesh_;
  std::vector<Place> places_;
};
}
