// SPDX-License-Identifier: BSD-3-Clause
#include "Stream.h"

#include "Report.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;

namespace neuralmesh::binding
{
Stream::Stream(const Parameters& parameters, std::size_t reservoirSize)
  : engine_(parameters, reservoirSize)
{
}

void Stream::addPoints(const std::vector<AnyArray>& points, const Sides& sides)
{
  const PointSpans spans = spansOf(points);
  const OrientationHints hints = sides.hints();
  const nb::gil_scoped_release unlocked;
  engine_.addPoints(spans, hints);
}

std::uint64_t Stream::learn(std::uint64_t samples, Call& call)
{
  const nb::gil_scoped_release unlocked;
  return engine_.learn(samples, call.part(0., 1.));
}

std::uint64_t Stream::learnForSeconds(double seconds, Call& call)
{
  const nb::gil_scoped_release unlocked;
  return engine_.learnFor(seconds, call.part(0., 1.));
}

nb::dict Stream::mesh(bool isFinished, const Sides& sides, Call& call) const
{
  if (!engine_.hasMesh())
  {
    return {};
  }
  OrientationHints hints = sides.hints();
  if (hints.viewpoints.size() == 1)
  {
    hints.viewpoints.clear(); // the points know it that were added while it was there
  }
  Reconstruction result;
  {
    const nb::gil_scoped_release unlocked;
    result = engine_.mesh(isFinished, call.part(0., 1.), hints);
  }
  nb::dict mesh = meshOf(result, true);
  nb::dict fields;
  addSides(result.orientation, fields);
  if (result.quality)
  {
    addQuality(result, engine_.unit(), fields);
    addCounts(*result.explanation, fields);
  }
  fields["Warnings"] = result.warnings;
  fields["NumberOfVertices"] = result.mesh.points.size();
  fields["Iterations"] = engine_.sampleCount();
  fields["Points"] = engine_.pointCount();
  fields["DroppedPoints"] = engine_.droppedCount();
  fields["Beginnings"] = engine_.beginnings();
  mesh["field_data"] = fields;
  return mesh;
}
}
