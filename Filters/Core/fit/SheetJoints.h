// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PlaceOnMesh.h"
#include "mesh/Mesh.h"

#include <cstddef>
#include <span>

namespace neuralmesh
{
/// Cuts apart sheets, or bodies, that have grown together where they nearly touch, and fills the holes. There, a narrow
/// tube leads from one to the other, and because of it their fronts look in opposite directions. Both have outlines of
/// their own, or both are closed, each is large, and hardly any samples lie on the tube. `places` are those of the samples
/// of the cloud, and `medianDistance` is that from them. Vertices of the tubes are erased. Returns how many tubes were cut.
std::size_t cutSheetJoints(Mesh& mesh, std::span<const PlaceOnMesh> places, float medianDistance,
  const Executor& executor = Executor::sequential());
}
