// SPDX-License-Identifier: BSD-3-Clause
// Meshes of surfaces: what comes in has triangles already.
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
/// What else a run may be asked for that a surface excludes.
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

/// Why a surface is not remeshed with this, as a sentence; empty if it is.
std::string whyNoRemeshing(const Parameters& parameters, const BesideSurface& beside);

/// How many samples of a surface a mesh with these parameters is fitted to.
std::size_t samplesOfSurface(const Parameters& parameters);

/// Remeshes `surface`, of which `samples` are points with normals, by their index in the cloud: refines and simplifies it
/// to as many vertices as the
/// parameters have, evens them, and fits them to the samples. Nothing is learnt, boundaries and sides stay what they
/// are. Where the topology needs more vertices, there are more.
Reconstruction remesh(const PointCloud& samples, const Parameters& parameters, Mesh surface,
  const PointNormals& normalOf, const Progress& progress,
  const Executor& executor = Executor::sequential());
}
