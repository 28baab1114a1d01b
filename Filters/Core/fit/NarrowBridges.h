// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Executor.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"

#include <cstddef>

namespace neuralmesh
{
/// Cuts narrow bridges without data between large parts of an open mesh, which are sheets of their own then: what is
/// left of a gap that was opened, where single samples lie. Because of it, one of them may look to the wrong side. On a
/// bridge, all ways lead across places that are farther from all samples than these are from each other, and than so
/// many times the distance `medianDistance` from them to the mesh. Its triangles are no more than a few edges away from
/// the boundaries on both sides. So a neck on which there are samples stays, and a closed mesh does. `samples` are
/// picked evenly from the cloud. Some vertices may be erased. Returns how many triangles were taken away.
std::size_t cutNarrowBridges(const PointCloud& cloud, Mesh& mesh, std::size_t samples,
  float medianDistance, const Executor& executor = Executor::sequential());
}
