// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "mesh/Mesh.h"

#include <span>

namespace neuralmesh
{
/// What is left once moves were taken back.
enum class AfterBrokenMoves
{
  Sound,
  Broken, ///< some triangles intersect or fold, though none of their vertices have moved
  Cancelled
};

/// Where the surface folds or intersects, vertices go back to where they were before they moved; `before` has the
/// positions of then. Again and again, as what goes back may run into what has not.
AfterBrokenMoves takeBackBrokenMoves(Mesh& mesh, std::span<const Vector4> before,
  const Progress& progress, const Executor& executor = Executor::sequential());
}
