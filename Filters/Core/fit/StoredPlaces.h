// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace neuralmesh
{
/// Places that are laid aside, but for their distances, in some 13 bytes each where neighbours on the mesh have indices
/// near to each other, and samples follow each other there.
class StoredPlaces
{
public:
  explicit StoredPlaces(std::span<const PlaceOnMesh> places, const Executor& executor);

  /// The places, with a distance of 0.
  std::vector<PlaceOnMesh> places(const Executor& executor) const;

private:
  std::size_t count_;
  std::vector<std::vector<std::uint8_t>> blocks_; ///< of so many places each
};
}
