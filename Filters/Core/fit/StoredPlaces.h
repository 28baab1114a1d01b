// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/ByteBlocks.h"
#include "base/Executor.h"
#include "base/ZeroedArray.h"
#include "cloud/PlaceOnMesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Packed places without their distances. A place takes about 13 bytes if indices of neighbours on
/// the mesh are close, and samples are in the order of their places.
class StoredPlaces
{
public:
  /// Frees the memory of the places as they are packed.
  StoredPlaces(ZeroedArray<PlaceOnMesh>&& places, const Executor& executor);

  /// The places, with a distance of 0. Frees the packed ones as they come back.
  ZeroedArray<PlaceOnMesh> takePlaces(const Executor& executor);

private:
  std::size_t count_;
  ByteBlocks bytes_;
};
}
