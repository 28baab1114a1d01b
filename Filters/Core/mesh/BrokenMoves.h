// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "base/Progress.h"
#include "mesh/Mesh.h"

namespace neuralmesh
{
/// What is left once moves were taken back.
enum class AfterBrokenMoves
{
  Untouched, ///< nothing was broken anywhere
  Sound,
  Broken, ///< some triangles intersect or fold, though none of their vertices have moved
  Cancelled
};

/// Where the surface folds or intersects, vertices go back to where they were before they moved; `before` has the
/// positions of then. Again and again, as what goes back may run into what has not.
AfterBrokenMoves takeBackBrokenMoves(Mesh& mesh, const PackedVectors& before,
  const Progress& progress, const Executor& executor = Executor::sequential());
}
