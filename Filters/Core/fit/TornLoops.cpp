// SPDX-License-Identifier: BSD-3-Clause
#include "fit/TornLoops.h"

#include "fit/EmptyPieces.h"
#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the samples that the surface around has on as large an area; where there is no surface, there are none.
constexpr double LeastPartInTear = 0.5;
/// Fewer lie together by chance.
constexpr double FewestInTear = 8.;

/// What the points tell of a loop.
struct SamplesAtLoop
{
  double beyond = 0.; ///< those with their places on the loop
  double around = 0.; ///< others on the triangles that touch it
  double area = 0.;   ///< of these
};

double enclosedArea(const Mesh& mesh, const std::vector<VertexIndex>& loop)
{
  const Vector4 origin = mesh.position(loop.front());
  Vector4 area;
  for (const VertexIndex v : loop)
  {
    area += cross(mesh.position(v) - origin, mesh.position(mesh.ring(v).back()) - origin);
  }
  return 0.5 * std::sqrt(double(squaredNorm(area)));
}

bool isTorn(const SamplesAtLoop& samples, double enclosed)
{
  return samples.beyond >= FewestInTear &&
    samples.beyond * samples.area >= LeastPartInTear * enclosed * samples.around;
}
}

std::size_t fillTornLoops(Mesh& mesh, std::span<const PlaceOnMesh> places)
{
  if (!mesh.isOpen())
  {
    return 0;
  }
  BoundaryManager boundaries(mesh);
  std::vector<SamplesAtLoop> samples(boundaries.loops().size());
  const auto loopOf = [&](const Triangle& triangle)
  {
    // A triangle that touches two of them counts at the one with the lower number.
    return std::min({ boundaries.loopOf(triangle[0]), boundaries.loopOf(triangle[1]),
      boundaries.loopOf(triangle[2]) });
  };
  for (const PlaceOnMesh& place : places)
  {
    const BoundaryManager::LoopIndex loop = loopOf(place.triangle);
    if (loop != BoundaryManager::NoLoop)
    {
      (isOnBoundary(place, mesh) ? samples[loop].beyond : samples[loop].around) += 1.;
    }
  }
  mesh.forEachTriangle(
    [&](VertexIndex a, VertexIndex b, VertexIndex c)
    {
      const BoundaryManager::LoopIndex loop = loopOf({ a, b, c });
      if (loop != BoundaryManager::NoLoop)
      {
        samples[loop].area += areaOf(mesh, { a, b, c });
      }
    });
  std::size_t filled = 0;
  for (BoundaryManager::LoopIndex index = 0; index < samples.size(); ++index)
  {
    const std::vector<VertexIndex> loop = boundaries.vertices(mesh, index);
    if (!loop.empty() && isTorn(samples[index], enclosedArea(mesh, loop)) &&
      fillBoundary(mesh, boundaries, index, CosineOfOutline))
    {
      ++filled;
    }
  }
  return filled;
}
}
