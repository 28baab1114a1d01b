// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Calls `visit` for each index of a vertex, in ranges of `grain` that may run at the same time.
template <typename Visit>
void forEachVertex(
  const Mesh& mesh, const Executor& executor, std::size_t grain, const Visit& visit)
{
  executor.forEachRange(mesh.indexEnd(), grain,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto v = VertexIndex(begin); v < end; ++v)
      {
        visit(v);
      }
    });
}
}
