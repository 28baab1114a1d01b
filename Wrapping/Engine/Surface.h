// SPDX-License-Identifier: BSD-3-Clause
// What is needed of a surface that is to be remeshed.
#pragma once

#include "Arrays.h"

#include <string>

namespace neuralmesh::binding
{
/// Why a surface is not remeshed with these parameters, beside what is true in the other dict; empty if it is.
std::string remeshingError(const nanobind::dict& parameters, const nanobind::dict& beside);

/// Samples of a surface for these parameters: points, normals, triangles and weights of corners, and as a manifold
/// surface_points and surface_triangles; a warning, which may be empty. Throws std::invalid_argument for what is no
/// surface.
nanobind::dict sampleSurface(const nanobind::dict& parameters, const ArrayOf<double>& points,
  const ArrayOf<std::int64_t>& triangles);
}
