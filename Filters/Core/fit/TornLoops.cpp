// SPDX-License-Identifier: BSD-3-Clause
#include "fit/TornLoops.h"

#include "mesh/BoundaryFilling.h"
#include "mesh/BoundaryManager.h"
#include "mesh/Pieces.h"

#include <algorithm>
#include <vector>

namespace neuralmesh
{
namespace
{
/// Of the samples that the surface around has on as large an area; where there is no surface, there are none.
constexpr double LeastPartInTear = 0.5;
/// The ragged rim of a hole has some of them, too: the fewer of what its area would have, the longer it is. Of a long gap
/// between two sheets, noise fills what is narrower than 2.7 of its deviations.
constexpr double LeastPartInLongTear = 0.3;
constexpr std::size_t FewestEdgesOfLong = 30;
/// Fewer lie together by chance.
constexpr double FewestInTear = 8.;

/// What the points tell of a loop.
struct SamplesAtLoop
{
  double beyond = 0.; ///< those with their places on the loop
  double around = 0.; ///< others on the triangles that touch it
  double area = 0.;   ///< of these
};

/// The area over which the points go on. That of the triangles is asked, as the sides of a loop around a slit may cancel
/// each other.
double areaWithSamples(const SamplesAtLoop& samples, std::size_t edges)
{
  const double least = edges < FewestEdgesOfLong ? LeastPartInTear : LeastPartInLongTear;
  const bool areMany = samples.beyond >= FewestInTear && samples.around > 0.;
  return areMany ? samples.beyond * samples.area / (least * samples.around) : 0.;
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
    const double area = areaWithSamples(samples[index], boundaries.loops()[index].size);
    filled += area > 0. && fillBoundary(mesh, boundaries, index, CosineOfOutline, area) ? 1 : 0;
  }
  return filled;
}
}
