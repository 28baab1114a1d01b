// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "learn/NeuralMesh.h"

#include <cstddef>
#include <cstdint>

namespace neuralmesh
{
class Archive;

/// The vertices of a first mesh behind which another layer is closer than edges are long. There the closest
/// vertex to a sample may be one of the layer behind, which the sample would draw through the surface: the
/// winner is to be the closest one of the layer that faces the sample.
class ThinParts
{
public:
  explicit ThinParts(NeuralMesh& neuralMesh);

  /// Looks for them among all vertices; before, there are none.
  void find(NeuralMesh& neuralMesh, const Executor& executor);
  bool any() const { return any_; }
  /// The winner that faces the sample, where `closest` is the closest vertex.
  VertexIndex facingWinner(const NeuralMesh& neuralMesh, Vector4 sample, VertexIndex closest) const;
  /// Looks at them again where the mesh has grown enough: the shorter edges become, the fewer parts are
  /// thin.
  void lookIfGrown(NeuralMesh& neuralMesh, const Executor& executor);

  void exchange(Archive& archive);

private:
  void look(NeuralMesh& neuralMesh, const Executor& executor);

  VertexProperty<std::uint8_t> isThin_;
  bool any_ = false;
  std::size_t nextLook_ = 0; ///< number of vertices
};
}
