// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run/PointDistances.h"

#include <cstddef>
#include <utility>

namespace neuralmesh::testing
{
inline PointDistances distancesTo(const Mesh& mesh, const PointCloud& cloud, std::size_t most,
  const Executor& executor = Executor::sequential())
{
  return std::move(measurePoints(
    mesh, cloud, { .all = most }, [](double) { return true; }, executor)
                     ->distances);
}

inline VertexSupport supportOf(const Mesh& mesh, const PointCloud& cloud, std::size_t most,
  const Executor& executor = Executor::sequential())
{
  return std::move(measurePoints(
    mesh, cloud, { .all = most, .forSupport = most }, [](double) { return true; }, executor)
                     ->support);
}
}
