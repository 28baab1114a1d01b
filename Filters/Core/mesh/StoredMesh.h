// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/ByteBlocks.h"
#include "base/Executor.h"
#include "base/PackedVectors.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// A mesh that is laid aside, in less than half of its memory: where neighbours have indices near to each other, some
/// 25 bytes a vertex in place of 80, beside its properties.
class StoredMesh
{
public:
  explicit StoredMesh(const Mesh& mesh, const Executor& executor = Executor::sequential());

  /// As it was.
  Mesh mesh(const Executor& executor = Executor::sequential()) const;
  std::size_t vertexCount() const { return rest_.vertexCount_; }

private:
  Mesh rest_; ///< without rings and positions
  std::size_t indexEnd_;
  PackedVectors positions_;
  ByteBlocks rings_;
};
}
