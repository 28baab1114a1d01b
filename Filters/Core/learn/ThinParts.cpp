// SPDX-License-Identifier: BSD-3-Clause
#include "learn/ThinParts.h"

#include "base/Archive.h"
#include "cloud/OppositeLayer.h"

#include <algorithm>

namespace neuralmesh
{
namespace
{
/// They are looked at whenever there are so many times more vertices.
constexpr double GrowthUntilLook = 1.5;
}

ThinParts::ThinParts(NeuralMesh& neuralMesh)
  : isThin_(neuralMesh.addProperty(std::uint8_t(0), OnSplit::Copy))
{
}

void ThinParts::find(NeuralMesh& neuralMesh, const Executor& executor)
{
  const std::span<std::uint8_t> isThin = neuralMesh.values(isThin_);
  std::fill(isThin.begin(), isThin.end(), std::uint8_t(1));
  look(neuralMesh, executor);
}

void ThinParts::look(NeuralMesh& neuralMesh, const Executor& executor)
{
  const std::span<std::uint8_t> isThin = neuralMesh.values(isThin_);
  const std::vector<VertexIndex> opposite = oppositeVertices(
    neuralMesh.mesh(), [&](Vector4 point) { return neuralMesh.winner(point); }, isThin, executor);
  std::transform(opposite.begin(), opposite.end(), isThin.begin(),
    [](VertexIndex v) { return std::uint8_t(v == NoVertex ? 0 : 1); });
  any_ = std::find(isThin.begin(), isThin.end(), 1) != isThin.end();
  nextLook_ = std::size_t(GrowthUntilLook * double(neuralMesh.vertexCount()));
}

void ThinParts::lookIfGrown(NeuralMesh& neuralMesh, const Executor& executor)
{
  if (any_ && neuralMesh.vertexCount() >= nextLook_)
  {
    look(neuralMesh, executor);
  }
}

VertexIndex ThinParts::facingWinner(
  const NeuralMesh& neuralMesh, Vector4 sample, VertexIndex closest) const
{
  const Mesh& mesh = neuralMesh.mesh();
  return mesh.values(isThin_)[closest] == 0
    ? closest
    : neuralmesh::facingWinner(
        sample, mesh, closest, [&](Vector4 point) { return neuralMesh.winner(point); });
}

void ThinParts::exchange(Archive& archive) { archive(any_, nextLook_); }
}
