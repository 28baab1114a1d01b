// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "mesh/Mesh.h"

#include <span>
#include <vector>

namespace neuralmesh
{
/// What L x is expected to be at each vertex of a smooth mesh: the mean curvature around it, over many rings, across
/// the surface. A fit that smooths towards that instead of 0 flattens no bend that is wider than these rings. `creases`
/// tells for each vertex what part of lambda counts there: where it is less than 1, and beside that, bends hardly count
/// for the mean. The mean itself counts only as far as chance does not explain it. 0 on boundaries.
///
/// `perVertex` is the number of samples per vertex: with few of them, the mean is over more rings.
std::vector<Vector4> expectedBends(
  const Mesh& mesh, std::span<const float> creases, double perVertex, const Executor& executor);
}
