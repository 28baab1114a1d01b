// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "learn/NeuralMesh.h"

namespace neuralmesh
{
/// How strongly the vertices tell of features: the normal counters of (8.5), which are averages and
/// do not decay. A vertex that comes out of a split is where the other one was, and tells the same.
class FeatureStrength
{
public:
  /// `memory` is alpha_fd: what a win leaves of the strength before it.
  FeatureStrength(NeuralMesh& mesh, double memory)
    : memory_(float(memory))
    , strength_(mesh.addProperty(0.f, OnSplit::Copy))
  {
  }

  /// `winner` won, and its normal turned by `gain` times the mean, n_delta.
  void win(NeuralMesh& mesh, VertexIndex winner, double gain) const
  {
    float& strength = mesh.values(strength_)[winner];
    strength = memory_ * strength + (1.f - memory_) * float(gain);
  }

  /// Where the mesh has the strengths.
  VertexProperty<float> property() const { return strength_; }

private:
  float memory_;
  VertexProperty<float> strength_;
};
}
