// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// The distance between samples and the length of edges around each vertex of a mesh. Both are
/// means over the triangles at the vertex and its neighbours, by their area and the samples with
/// places there. They cost almost nothing. A part of the mesh without samples counts as if it had
/// one.
class LocalSpacing
{
public:
  /// `places` are those of the samples. No vertex may be erased.
  LocalSpacing(const Mesh& mesh, std::span<const PlaceOnMesh> places,
    const Executor& executor = Executor::sequential());

  /// The distance between samples around a place, in units of the cloud: the root of the area per
  /// sample.
  float samplesAt(const PlaceOnMesh& place) const { return meanAt(spacings_, place); }
  float samplesAt(VertexIndex v) const { return spacings_[v]; }
  /// The distance between samples on the whole mesh.
  float usual() const { return usual_; }
  /// The mean edge around a place.
  float edgeAt(const PlaceOnMesh& place) const { return meanAt(edges_, place); }
  /// Frees the memory of the edges, which are not needed any more.
  void forgetEdges() { edges_ = {}; }

private:
  static float meanAt(const ZeroedArray<float>& values, const PlaceOnMesh& place)
  {
    return 1.f / 3.f *
      (values[place.triangle[0]] + values[place.triangle[1]] + values[place.triangle[2]]);
  }

  ZeroedArray<float> spacings_;
  ZeroedArray<float> edges_;
  float usual_ = 0.f;
};
}
