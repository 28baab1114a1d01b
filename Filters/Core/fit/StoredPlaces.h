// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/ByteBlocks.h"
#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// Places that are laid aside, but for their distances, in some 13 bytes each where neighbours on the mesh have indices
/// near to each other, and samples follow each other there.
class StoredPlaces
{
public:
  StoredPlaces(std::span<const PlaceOnMesh> places, const Executor& executor);

  /// The places, with a distance of 0.
  ZeroedArray<PlaceOnMesh> places(const Executor& executor) const;

private:
  std::size_t count_;
  ByteBlocks bytes_;
};
}
