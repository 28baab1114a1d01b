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

double volumeOf(const Mesh& mesh, const Executor& executor)
{
  return executor.sum(mesh.indexEnd(), VerticesOfCrumpledPart,
    [&](std::size_t v)
    {
      double volume = 0.;
      mesh.forEachTriangleFrom(VertexIndex(v),
        [&](VertexIndex a, VertexIndex b, VertexIndex c) {
          volume += double(dot(mesh.position(a), cross(mesh.position(b), mesh.position(c)))) / 6.;
        });
      return volume;
    });
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
  const double thickness = 2. * std::abs(volumeOf(mesh, executor)) / areaOf(mesh, executor);
  if (thickness < LeastThickness * noiseAround(mesh, cloud, executor))
  {
    forEachVertex(mesh, executor, VerticesOfCrumpledPart,
      [&](VertexIndex v) { mesh.setPosition(v, before[v]); });
  }
}
}
