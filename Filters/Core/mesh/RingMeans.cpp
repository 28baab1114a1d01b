// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/RingMeans.h"

namespace neuralmesh
{
void averageOverRings(
  const Mesh& mesh, std::vector<float>& values, int rings, const Executor& executor)
{
  constexpr std::size_t VerticesPerRange = 4096;
  std::vector<float> next(values.size());
  for (int ring = 0; ring < rings; ++ring)
  {
    executor.forEachRange(values.size(), VerticesPerRange,
      [&](std::size_t begin, std::size_t end)
      {
        for (auto v = VertexIndex(begin); v < end; ++v)
        {
          float sum = values[v];
          for (const VertexIndex neighbor : mesh.ring(v))
          {
            sum += values[neighbor];
          }
          next[v] = sum / float(1 + mesh.valence(v));
        }
      });
    values.swap(next);
  }
}
}
