// SPDX-License-Identifier: BSD-3-Clause
#include "fit/LocalSpacing.h"

#include "fit/PlacesByRows.h"
#include "mesh/EachVertex.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
/// The size of a part for the executor.
constexpr std::size_t SpacingsPerRange = 4096;
}

LocalSpacing::LocalSpacing(
  const Mesh& mesh, std::span<const PlaceOnMesh> places, const Executor& executor)
  : spacings_(mesh.indexEnd())
  , edges_(mesh.indexEnd())
{
  // The areas and samples of the triangles at each vertex. Both count at three vertices.
  ZeroedArray<float> areas(mesh.indexEnd()), samples(mesh.indexEnd());
  forEachPlaceByRows(
    places, RowParts(mesh.indexEnd(), executor), executor, [](std::size_t) { return true; },
    [&](const VertexRows& rows, std::size_t i)
    {
      for (const VertexIndex v : places[i].triangle)
      {
        if (rows.has(v))
        {
          samples[v] += 1.f;
        }
      }
    });
  forEachVertex(mesh, executor, SpacingsPerRange,
    [&](VertexIndex v)
    {
      const Ring& ring = mesh.ring(v);
      Vector4 before = mesh.position(ring.back()) - mesh.position(v);
      for (unsigned slot = 0; slot < ring.size(); ++slot)
      {
        const Vector4 side = mesh.position(ring[slot]) - mesh.position(v);
        edges_[v] += std::sqrt(squaredNorm(side)) / float(ring.size());
        if (slot > 0 || !ring.isOpen())
        {
          areas[v] += 0.5f * std::sqrt(squaredNorm(cross(before, side)));
        }
        before = side;
      }
    });
  forEachVertex(mesh, executor, SpacingsPerRange,
    [&](VertexIndex v)
    {
      float area = areas[v], count = samples[v];
      for (const VertexIndex neighbor : mesh.ring(v))
      {
        area += areas[neighbor];
        count += samples[neighbor];
      }
      spacings_[v] = std::sqrt(area / std::max(1.f, count));
    });
  // Each triangle counts at three vertices.
  const double area =
    executor.sum(areas.size(), SpacingsPerRange, [&](std::size_t v) { return double(areas[v]); }) /
    3.;
  usual_ = float(std::sqrt(area / double(std::max<std::size_t>(1, places.size()))));
}
}
