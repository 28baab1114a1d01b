// SPDX-License-Identifier: BSD-3-Clause
#include "Stream.h"

#include "Report.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
/// Learnt between two looks at the clock.
constexpr std::uint64_t SamplesPerLook = 20000;
}

Stream::Stream(const Parameters& parameters, std::size_t reservoirSize)
  : engine_(parameters, reservoirSize)
{
}

void Stream::addPoints(const std::vector<AnyArray>& points, const Sides& sides)
{
  const PointSpans spans = spansOf(points);
  const OrientationHints hints = sides.hints();
  const nb::gil_scoped_release unlocked;
  const auto viewOf = [&](std::uint32_t point)
  { return hints.viewOf ? hints.viewOf(point) : std::uint32_t(0); };
  // Of several viewpoints without a view of each point the mesh tells later what was seen from where.
  const bool haveViews = hints.viewOf || hints.viewpoints.size() == 1;
  StreamingReconstruction::DirectionOf directionOf;
  if (haveViews || hints.normalOf)
  {
    directionOf = [&](std::size_t index) -> Eigen::Vector3d
    {
      const auto point = std::uint32_t(index);
      if (haveViews && viewOf(point) < hints.viewpoints.size())
      {
        return hints.viewpoints[viewOf(point)] - spans[index];
      }
      return hints.normalOf ? hints.normalOf(point) : Eigen::Vector3d::Zero();
    };
  }
  engine_.addPoints(spans, directionOf);
}

std::uint64_t Stream::learn(std::uint64_t samples, Call& call)
{
  const nb::gil_scoped_release unlocked;
  return engine_.learn(samples, call.part(0., 1.));
}

std::uint64_t Stream::learnForSeconds(double seconds, Call& call)
{
  const nb::gil_scoped_release unlocked;
  const Progress report = [&](double)
  { return call.report(seconds > 0. ? std::min(1., call.seconds() / seconds) : 1.); };
  std::uint64_t all = 0, learnt = 0;
  do
  {
    learnt = engine_.learn(SamplesPerLook, report);
    all += learnt;
  } while (call.goesOn() && learnt > 0 && call.seconds() < seconds);
  return all;
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
