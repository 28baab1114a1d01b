// SPDX-License-Identifier: BSD-3-Clause
// The point cloud that a scan of a surface might give, as vtkNeuralMeshScan makes it.
#pragma once

#include "Arrays.h"
#include "Call.h"

#include "cloud/CloudGenerator.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace neuralmesh::binding
{
/// Of the properties of vtkNeuralMeshScan, by their names.
CloudOptions scanOptionsOf(const nanobind::dict& properties);

/// Points of shape (N, 3) in coordinates of the surface; none if it was ended. With a viewpoint without
/// what is not seen from there. Throws std::invalid_argument where no triangle has an area.
nanobind::object scan(TriangleMesh surface, CloudOptions options,
  const std::optional<ArrayOf<double>>& viewpoint, bool isDouble, Call& call);
}
