// SPDX-License-Identifier: BSD-3-Clause
// The module neuralmesh._engine: the learning engine for the Python package where no VTK has been built
// with it. Internal to that package, which checks what it hands over.
#include "Arrays.h"
#include "Call.h"
#include "Run.h"
#include "Values.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;
using namespace nb::literals;

namespace neuralmesh::binding
{
namespace
{
void learn(Run& run, const nb::dict& parameters, std::optional<nb::dict> ensemble,
  const std::optional<ArrayOf<double>>& firstPoints,
  const std::optional<ArrayOf<std::int64_t>>& firstTriangles, bool automatic, bool explain,
  double endOfMesh, std::string checkpoint, double checkpointInterval, std::size_t snapshots,
  nb::object takeSnapshot, nb::object progress)
{
  Run::Plan plan{ parameters, std::move(ensemble), {}, automatic, explain, endOfMesh,
    std::move(checkpoint), checkpointInterval, snapshots, std::move(takeSnapshot) };
  if (firstPoints && firstTriangles)
  {
    plan.firstMesh = meshOf(*firstPoints, *firstTriangles);
  }
  Call call(std::move(progress));
  run.learn(std::move(plan), call);
  call.rethrow();
}

void bindRun(nb::module_& module)
{
  nb::class_<Run>(module, "Run")
    .def(
      "__init__",
      [](Run* run, std::vector<AnyArray> points, std::optional<ArrayOf<double>> weights,
        ArrayOf<double> viewpoints, std::optional<ArrayOf<std::uint32_t>> views,
        std::optional<ArrayOf<double>> normals, std::optional<ArrayOf<double>> up,
        bool keepsOrigins, unsigned threads)
      {
        new (run) Run(std::move(points), std::move(weights),
          Sides{ std::move(viewpoints), std::move(views), std::move(normals), std::move(up) },
          keepsOrigins, threads);
      },
      "points"_a, "weights"_a.none(), "viewpoints"_a, "views"_a.none(), "normals"_a.none(),
      "up"_a.none(), "keeps_origins"_a, "threads"_a)
    .def("needs_doubles", &Run::needsDoubles, "vertices"_a)
    .def("learn", &learn, "parameters"_a, "ensemble"_a.none(), "first_points"_a.none(),
      "first_triangles"_a.none(), "automatic"_a, "explain"_a, "end_of_mesh"_a, "checkpoint"_a,
      "checkpoint_interval"_a, "snapshots"_a, "take_snapshot"_a.none(), "progress"_a.none())
    .def("mesh", &Run::mesh, "double"_a)
    .def("curve", &Run::curve)
    .def("explained", &Run::explained)
    .def("times", &Run::times)
    .def_prop_ro("warnings", &Run::warnings)
    .def_prop_ro("stop_reason", &Run::stopReason)
    .def_prop_ro("is_complete", &Run::isComplete)
    .def_prop_ro("resumed_iterations", &Run::resumedIterations);
}

NB_MODULE(_engine, module)
{
  module.def(
    "preset",
    [](int preset, int variant, int order)
    { return presetOf(Preset(preset), Variant(variant), Order(order)); },
    "preset"_a, "variant"_a, "order"_a);
  module.def(
    "errors", [](const nb::dict& parameters) { return parametersOf(parameters).errors(); },
    "parameters"_a);
  bindRun(module);
}
}
}
