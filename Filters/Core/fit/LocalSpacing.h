// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// How far the samples of a cloud are from each other, and how long edges are, around each vertex of
/// a mesh: by the area of the triangles at the vertex and its neighbours, and the samples that have
/// their places there. So it costs next to nothing, but is the mean of some ten triangles, and tells
/// nothing of a part of the mesh without samples, where it is as if there were one.
class LocalSpacing
{
public:
  /// `places` are those of the samples. No vertex may be erased.
  LocalSpacing(const Mesh& mesh, std::span<const PlaceOnMesh> places,
    const Executor& executor = Executor::sequential());

  /// The root of the area for a sample, around a place, in units of the cloud.
  float samplesAt(const PlaceOnMesh& place) const { return meanAt(spacings_, place); }
  float samplesAt(VertexIndex v) const { return spacings_[v]; }
  /// That of all samples on the whole mesh.
  float usual() const { return usual_; }
  /// The mean edge.
  float edgeAt(const PlaceOnMesh& place) const { return meanAt(edges_, place); }
  /// Edges are not asked for any more.
  void forgetEdges() { std::vector<float>().swap(edges_); }

private:
  static float meanAt(const std::vector<float>& values, const PlaceOnMesh& place)
  {
    return 1.f / 3.f *
      (values[place.triangle[0]] + values[place.triangle[1]] + values[place.triangle[2]]);
  }

  std::vector<float> spacings_;
  std::vector<float> edges_;
  float usual_ = 0.f;
};
}
