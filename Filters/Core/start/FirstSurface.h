// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Choices.h"
#include "base/Executor.h"
#include "base/Progress.h"
#include "cloud/PointCloud.h"
#include "mesh/Mesh.h"
#include "start/FrontSurface.h"

#include <cstddef>
#include <optional>

namespace neuralmesh
{
/// A coarse surface of the topology of the shape, to start learning from.
struct FirstSurface
{
  Mesh mesh;
  unsigned resolution =
    0; ///< of the grid that it comes from; 0 for a front, open where it is to be
  long genus = 0;
  std::size_t components = 0;
  bool isOpen = false;
  bool isCertain = false;  ///< whether the next coarser grid gives the same topology
  double bridgeWidth = 0.; ///< gaps up to about that were closed
  bool isLeaky = false;    ///< whether finer grids leak though the points are dense enough for them
  float skinThickness = 0.f; ///< about, if it is a skin around points that enclose nothing
};

/// The surface of the space that the cloud occupies or encloses, from a grid: the finest one tried
/// that does enclose something, and whose topology the next coarser one confirms. If no grid
/// encloses anything the cloud is open, and it is one sheet. Then fitted to the cloud, and opened
/// where there is no data, or closed.
///
/// Where that does not explain the points, as what they lie on is thin, uneven, or open, a front is grown
/// over samples of the layers; what explains more is taken.
///
/// Of a front, pieces of less than `leastPiece` of the triangles are dropped. From a grid it has at most
/// `mostVertices`, from a front at most `mostOfFront`. Nothing if that is too few for the topology, or the
/// cloud has too few points to tell.
std::optional<FirstSurface> firstSurface(const PointCloud& cloud, std::size_t mostVertices,
  std::size_t mostOfFront, Boundaries boundaries, const Progress& progress,
  const Executor& executor = Executor::sequential(), double leastPiece = LeastPiece);

/// The front alone, if it is certain and explains the points. It shows holes and gaps that a grid has closed because they
/// are narrower than its voxels, or than the edges of its surface, and that hold too few of the points to be missed.
std::optional<FirstSurface> surfaceWithNarrowParts(const PointCloud& cloud, std::size_t mostOfFront,
  Boundaries boundaries, const Progress& progress,
  const Executor& executor = Executor::sequential(), double leastPiece = LeastPiece);
}
