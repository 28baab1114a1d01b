// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/NearestMarked.h"

namespace neuralmesh
{
std::vector<VertexIndex> nearestMarked(const Mesh& mesh, const std::vector<bool>& marked)
{
  std::vector<VertexIndex> nearest(mesh.indexEnd(), NoVertex);
  std::vector<VertexIndex> front; // breadth first
  front.reserve(mesh.indexEnd());
  for (VertexIndex v = 0; v < mesh.indexEnd(); ++v)
  {
    if (marked[v])
    {
      nearest[v] = v;
      front.push_back(v);
    }
  }
  for (std::size_t i = 0; i < front.size(); ++i)
  {
    for (const VertexIndex neighbor : mesh.ring(front[i]))
    {
      if (nearest[neighbor] == NoVertex)
      {
        nearest[neighbor] = nearest[front[i]];
        front.push_back(neighbor);
      }
    }
  }
  return nearest;
}
}
