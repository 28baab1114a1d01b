// SPDX-License-Identifier: BSD-3-Clause
#include "fit/CrumpledMesh.h"

#include "fit/HeldOutPoints.h"
#include "mesh/Crumples.h"
#include "mesh/EachVertex.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace neuralmesh
{
namespace
{
/// For the executor.
constexpr std::size_t VerticesOfCrumpledPart = 4096;
/// Points that measure the noise.
constexpr std::size_t PointsForNoise = 3000;
/// A body is at least so many deviations thick, as twice its volume over its area tells.
constexpr double LeastThickness = 2.;

/// Of all pieces together.
double thicknessOf(const Mesh& mesh, const Executor& executor)
{
  double volume = 0., area = 0.;
  for (const Piece& piece : findPieces(mesh, executor))
  {
    volume += std::abs(piece.volume);
    area += piece.area;
  }
  return area > 0. ? 2. * volume / area : 0.;
}

double noiseAround(const Mesh& mesh, const PointCloud& cloud, const Executor& executor)
{
  const std::vector<float> squared =
    squaredDistances(cloud, heldOutPoints(cloud, PointsForNoise), mesh, executor);
  const double sum = std::accumulate(squared.begin(), squared.end(), 0.);
  return std::sqrt(sum / double(std::max<std::size_t>(1, squared.size())));
}
}

void smoothCrumpledMesh(Mesh& mesh, const PointCloud& cloud, const Executor& executor)
{
  const std::vector<Vector4> before = smoothCrumples(mesh, executor);
  if (before.empty() || mesh.isOpen(executor))
  {
    return;
  }
  if (thicknessOf(mesh, executor) < LeastThickness * noiseAround(mesh, cloud, executor))
  {
    forEachVertex(mesh, executor, VerticesOfCrumpledPart,
      [&](VertexIndex v) { mesh.setPosition(v, before[v]); });
  }
}
}
