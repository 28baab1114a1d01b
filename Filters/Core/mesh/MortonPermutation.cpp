// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/MortonPermutation.h"

#include "base/Morton.h"

namespace neuralmesh
{
std::vector<VertexIndex> mortonPermutation(
  const Mesh& mesh, Vector4 boxMin, Vector4 boxMax, const Executor& executor)
{
  if (mesh.vertexCount() == mesh.indexEnd())
  {
    return mortonOrder(mesh.positions(), boxMin, boxMax, executor);
  }
  std::vector<VertexIndex> alive;
  std::vector<Vector4> positions;
  alive.reserve(mesh.vertexCount());
  positions.reserve(mesh.vertexCount());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (mesh.isAlive(v))
    {
      alive.push_back(v);
      positions.push_back(mesh.position(v));
    }
  }
  std::vector<VertexIndex> permutation = mortonOrder(positions, boxMin, boxMax, executor);
  for (VertexIndex& v : permutation)
  {
    v = alive[v];
  }
  return permutation;
}
}
