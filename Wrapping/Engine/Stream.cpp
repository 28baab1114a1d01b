// SPDX-License-Identifier: BSD-3-Clause
#include "Stream.h"

#include "Report.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>

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
  sides.requireCount(spans.size());
  const OrientationHints hints = sides.hints();
  const nb::gil_scoped_release unlocked;
  const std::lock_guard alone(mutex_);
  engine_.addPoints(spans, hints);
}

std::uint64_t Stream::learn(std::uint64_t samples, Call& call)
{
  const nb::gil_scoped_release unlocked;
  const std::lock_guard alone(mutex_);
  return engine_.learn(samples, call.part(0., 1.));
}

std::uint64_t Stream::learnForSeconds(double seconds, Call& call)
{
  const nb::gil_scoped_release unlocked;
  const std::lock_guard alone(mutex_);
  return engine_.learnFor(seconds, call.part(0., 1.));
}

nb::dict Stream::mesh(bool isFinished, const Sides& sides, Call& call) const
{
  OrientationHints hints = sides.hints();
  if (hints.viewpoints.size() == 1)
  {
    hints.viewpoints.clear(); // the points know it that were added while it was there
  }
  std::optional<Reconstruction> found;
  double unit = 1.;
  nb::dict fields;
  {
    const nb::gil_scoped_release unlocked;
    const std::lock_guard alone(mutex_);
    if (engine_.hasMesh())
    {
      found = engine_.mesh(isFinished, call.part(0., 1.), hints);
      unit = engine_.unit();
    }
  }
  if (!found)
  {
    return {};
  }
  const Reconstruction& result = *found;
  nb::dict mesh = meshOf(result, true);
  addSides(result.orientation, fields);
  if (result.quality)
  {
    addQuality(result, unit, fields);
    addCounts(*result.explanation, fields);
  }
  fields["Warnings"] = result.warnings;
  fields["NumberOfVertices"] = result.mesh.points.size();
  look(
    [&](const StreamingReconstruction& engine)
    {
      const nb::gil_scoped_acquire locked;
      fields["Iterations"] = engine.sampleCount();
      fields["Points"] = engine.pointCount();
      fields["DroppedPoints"] = engine.droppedCount();
      fields["Beginnings"] = engine.beginnings();
      return true;
    });
  mesh["field_data"] = fields;
  return mesh;
}
}
