// SPDX-License-Identifier: BSD-3-Clause
// Remeshing: the input is a surface of triangles.
#pragma once

#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "fit/GivenNormals.h"
#include "learn/Parameters.h"
#include "mesh/Mesh.h"
#include "run/Reconstruction.h"

#include <cstdint>
#include <string>

namespace neuralmesh
{
/// Other requests that a surface excludes.
struct BesideSurface
{
  bool points = false; ///< in a file, in place of an input
  bool firstMesh = false;
  bool weights = false;
  bool sides = false; ///< viewpoints, views, normals that are named, or an up direction
  bool size = false;  ///< a number of vertices that is to be found
  bool levels = false;
  bool checkpoint = false;
  bool snapshots = false;
  bool automatic = false;
  bool explanation = false;
  bool estimate = false; ///< of what a run takes, without it
};

/// The reason why a surface cannot be remeshed with these, as a sentence; empty if it can.
std::string whyNoRemeshing(const Parameters& parameters, const BesideSurface& beside);

/// The number of samples of a surface to which a mesh with these parameters is fitted.
std::size_t samplesOfSurface(const Parameters& parameters);

/// Remeshes `surface`; `samples` are points on it with normals by their index in the cloud. Refines
/// and simplifies it to the number of vertices of the parameters, makes it more even, and fits it
/// to the samples. Nothing is learnt. Boundaries and sides do not change. The mesh has more
/// vertices if the topology needs them.
Reconstruction remesh(const PointCloud& samples, const Parameters& parameters, Mesh surface,
  const PointNormals& normalOf, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
