// SPDX-License-Identifier: BSD-3-Clause
// The module neuralmesh._engine: the learning engine for the Python package where no VTK has been built
// with it. Internal to that package, which checks what it hands over.
#include "Arrays.h"
#include "Call.h"
#include "Drawing.h"
#include "Files.h"
#include "Measures.h"
#include "Report.h"
#include "Run.h"
#include "Scan.h"
#include "Stream.h"
#include "Surface.h"
#include "Tune.h"
#include "Values.h"

#include "base/AtomicFile.h"
#include "base/AvailableProcessors.h"
#include "run/Ensemble.h"
#include "run/RunEstimate.h"

#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <string>

namespace nb = nanobind;
using namespace nb::literals;

namespace neuralmesh::binding
{
namespace
{
/// What is wrong with the mesh is said behind a text.
TriangleMesh namedMeshOf(
  const char* before, const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles)
{
  try
  {
    return meshOf(points, triangles);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string(before) + error.what() + ".");
  }
}

void learn(Run& run, const nb::dict& parameters, std::optional<nb::dict> ensemble,
  const std::optional<ArrayOf<double>>& firstPoints,
  const std::optional<ArrayOf<std::int64_t>>& firstTriangles, double tolerance, bool isPercent,
  int measure, bool automatic, bool explain, double endOfMesh, std::string checkpoint,
  double checkpointInterval, std::size_t snapshots, std::vector<std::uint64_t> levels,
  std::optional<std::string> warningOfSurface, nb::object takeSnapshot, nb::object tell,
  nb::object progress)
{
  Run::Plan plan{ parameters, std::move(ensemble), {},
    { tolerance, isPercent, ToleranceMeasure(measure) }, automatic, explain, endOfMesh,
    std::move(checkpoint), checkpointInterval, snapshots, std::move(levels),
    std::move(warningOfSurface), std::move(takeSnapshot), std::move(tell) };
  if (firstPoints && firstTriangles)
  {
    plan.firstMesh =
      namedMeshOf("Learning cannot start from the first mesh: ", *firstPoints, *firstTriangles);
  }
  Call call(std::move(progress));
  run.learn(std::move(plan), call);
  call.rethrow();
}

void bindRun(nb::module_& module)
{
  module.def(
    "why_no_size",
    [](const nb::dict& parameters, bool first, bool checkpoint, bool automatic)
    {
      return whyNoSize(parametersOf(parameters),
        { .firstMesh = first, .checkpoint = checkpoint, .automatic = automatic });
    },
    "parameters"_a, "first_mesh"_a, "checkpoint"_a, "automatic"_a);
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
      "first_triangles"_a.none(), "tolerance"_a, "tolerance_is_percent"_a, "tolerance_measure"_a,
      "automatic"_a, "explain"_a, "end_of_mesh"_a, "checkpoint"_a, "checkpoint_interval"_a,
      "snapshots"_a, "levels"_a, "warning_of_surface"_a.none(), "take_snapshot"_a.none(),
      "tell"_a.none(), "progress"_a.none())
    .def_prop_ro("smaller_levels", &Run::smallerLevels)
    .def("show", &Run::show, "level"_a)
    .def("mesh", &Run::mesh, "double"_a)
    .def("average", &Run::average, "double"_a)
    .def("votes", &Run::votes)
    .def("curve", &Run::curve)
    .def("explained", &Run::explained)
    .def(
      "feature_lines",
      [](Run& run, double angle, bool isDouble, double begin, double end, nb::object progress)
      {
        Call call(std::move(progress));
        nb::dict lines = run.featureLines(angle, isDouble, call, begin, end);
        call.rethrow();
        return lines;
      },
      "angle"_a, "double"_a, "begin"_a, "end"_a, "progress"_a.none())
    .def("times", &Run::times)
    .def(
      "find_places",
      [](Run& run, double begin, double end, nb::object progress)
      {
        Call call(std::move(progress));
        const bool isDone = run.findPlaces(call, begin, end);
        call.rethrow();
        return isDone;
      },
      "begin"_a, "end"_a, "progress"_a.none())
    .def("fit", &Run::fit, "values"_a)
    .def("vote", &Run::vote, "kinds"_a)
    .def_prop_ro("warnings", &Run::warnings)
    .def_prop_ro("stop_reason", &Run::stopReason)
    .def_prop_ro("is_complete", &Run::isComplete)
    .def_prop_ro("resumed_iterations", &Run::resumedIterations);
}

Sides sidesOf(ArrayOf<double> viewpoints, std::optional<ArrayOf<std::uint32_t>> views,
  std::optional<ArrayOf<double>> normals, std::optional<ArrayOf<double>> up)
{
  return { std::move(viewpoints), std::move(views), std::move(normals), std::move(up) };
}

void bindStream(nb::module_& module)
{
  nb::class_<Stream>(module, "Stream")
    .def(
      "__init__",
      [](Stream* stream, const nb::dict& parameters, std::size_t reservoirSize)
      { new (stream) Stream(parametersOf(parameters), reservoirSize); },
      "parameters"_a, "reservoir_size"_a)
    .def(
      "add_points",
      [](Stream& stream, const std::vector<AnyArray>& points, ArrayOf<double> viewpoints,
        std::optional<ArrayOf<std::uint32_t>> views, std::optional<ArrayOf<double>> normals,
        std::optional<ArrayOf<double>> up)
      {
        stream.addPoints(points,
          sidesOf(std::move(viewpoints), std::move(views), std::move(normals), std::move(up)));
      },
      "points"_a, "viewpoints"_a, "views"_a.none(), "normals"_a.none(), "up"_a.none())
    .def(
      "learn",
      [](Stream& stream, std::uint64_t samples, nb::object progress)
      {
        Call call(std::move(progress));
        const std::uint64_t learnt = stream.learn(samples, call);
        call.rethrow();
        return learnt;
      },
      "samples"_a, "progress"_a.none())
    .def(
      "learn_for_seconds",
      [](Stream& stream, double seconds, nb::object progress)
      {
        Call call(std::move(progress));
        const std::uint64_t learnt = stream.learnForSeconds(seconds, call);
        call.rethrow();
        return learnt;
      },
      "seconds"_a, "progress"_a.none())
    .def(
      "mesh",
      [](const Stream& stream, bool isFinished, ArrayOf<double> viewpoints,
        std::optional<ArrayOf<std::uint32_t>> views, std::optional<ArrayOf<double>> normals,
        std::optional<ArrayOf<double>> up, nb::object progress)
      {
        Call call(std::move(progress));
        nb::dict mesh = stream.mesh(isFinished,
          sidesOf(std::move(viewpoints), std::move(views), std::move(normals), std::move(up)),
          call);
        call.rethrow();
        return mesh;
      },
      "finished"_a, "viewpoints"_a, "views"_a.none(), "normals"_a.none(), "up"_a.none(),
      "progress"_a.none())
    .def_prop_ro("points",
      [](const Stream& stream)
      { return stream.look([](const auto& engine) { return engine.pointCount(); }); })
    .def_prop_ro("dropped_points",
      [](const Stream& stream)
      { return stream.look([](const auto& engine) { return engine.droppedCount(); }); })
    .def_prop_ro("samples",
      [](const Stream& stream)
      { return stream.look([](const auto& engine) { return engine.sampleCount(); }); })
    .def_prop_ro("vertices",
      [](const Stream& stream)
      { return stream.look([](const auto& engine) { return engine.vertexCount(); }); })
    .def_prop_ro("beginnings",
      [](const Stream& stream)
      { return stream.look([](const auto& engine) { return engine.beginnings(); }); });
}

void bindMeasures(nb::module_& module)
{
  module.def(
    "compare",
    [](const ArrayOf<double>& referencePoints, const ArrayOf<std::int64_t>& referenceTriangles,
      const ArrayOf<double>& resultPoints, const ArrayOf<std::int64_t>& resultTriangles,
      std::size_t samples, std::uint64_t seed, nb::object progress)
    {
      Call call(std::move(progress));
      nb::object figures = compare(meshOf(referencePoints, referenceTriangles),
        meshOf(resultPoints, resultTriangles), samples, seed, call);
      call.rethrow();
      return figures;
    },
    "reference_points"_a, "reference_triangles"_a, "result_points"_a, "result_triangles"_a,
    "samples"_a, "seed"_a, "progress"_a.none());
  module.def(
    "explain",
    [](const std::vector<AnyArray>& points, const ArrayOf<double>& meshPoints,
      const ArrayOf<std::int64_t>& triangles, double leastPiece, nb::object progress)
    {
      Call call(std::move(progress));
      nb::object explained = explain(
        points, namedMeshOf("The mesh cannot be used: ", meshPoints, triangles), leastPiece, call);
      call.rethrow();
      return explained;
    },
    "points"_a, "mesh_points"_a, "triangles"_a, "least_piece"_a, "progress"_a.none());
  module.def(
    "scan",
    [](const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles,
      const nb::dict& options, const std::optional<ArrayOf<double>>& viewpoint, bool isDouble,
      nb::object progress)
    {
      Call call(std::move(progress));
      nb::object cloud =
        scan(meshOf(points, triangles), scanOptionsOf(options), viewpoint, isDouble, call);
      call.rethrow();
      return cloud;
    },
    "points"_a, "triangles"_a, "options"_a, "viewpoint"_a.none(), "double"_a, "progress"_a.none());
  module.def(
    "report",
    [](const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles)
    { return report(meshOf(points, triangles)); },
    "points"_a, "triangles"_a);
  module.def("available_processors", &availableProcessors);
  module.attr("tried_vertices") = TriedVertices;
  module.attr("tried_additions") = TriedAdditions;
  module.attr("most_tried_start") = MostTriedStart;
  module.def("estimate", &estimate, "plan"_a, "trial"_a, "start"_a, "wall_seconds"_a);
  module.def("learnt_vertices", &learntVertices, "plan"_a);
  module.def(
    "tune",
    [](const std::vector<AnyArray>& points, const nb::dict& parameters, unsigned threads,
      nb::object progress)
    {
      Call call(std::move(progress));
      nb::object tuning = tuneFor(points, parametersOf(parameters), threads, call);
      call.rethrow();
      return tuning;
    },
    "points"_a, "parameters"_a, "threads"_a, "progress"_a.none());
}

void bindFiles(nb::module_& module)
{
  module.def(
    "draw_points",
    [](const std::string& path, std::uint64_t wanted, std::uint64_t seed, nb::object progress,
      const std::string& raw, std::uint64_t skip)
    {
      Call call(std::move(progress));
      nb::object points = drawPoints(path, { raw, skip }, wanted, seed, call);
      call.rethrow();
      return points;
    },
    "path"_a, "wanted"_a, "seed"_a, "progress"_a.none(), "raw"_a = "", "skip"_a = 0);
  module.def("read_points", &readPoints, "path"_a);
  module.def("read_guarded", &readGuarded, "path"_a, "read"_a);
  module.def("write_mesh", &writeSurface, "path"_a, "points"_a, "triangles"_a, "normals"_a.none(),
    "colors"_a.none(), "shift"_a.none(), "noted"_a);
  module.def("require_digits", &requireDigitsFor, "path"_a, "points"_a, "vertices"_a, "shift"_a);
  module.def("round_shift", &roundShiftOf, "points"_a);
  module.def("shift_note", &noteOf, "shift"_a);
  module.def("require_place", &requirePlace, "path"_a);
  module.def("write_whole", &writeWhole, "path"_a, "content"_a);
  module.def("join_views", &joinViews, "parts"_a);
  module.def("usual_points", &usualPoints, "vertices"_a);
  module.def("remove_file", &removeAtomicFile, "path"_a);
}

NB_MODULE(_engine, module)
{
  module.attr("version") = NEURALMESH_VERSION;
  module.def(
    "preset",
    [](int preset, int variant, int order)
    { return presetOf(Preset(preset), Variant(variant), Order(order)); },
    "preset"_a, "variant"_a, "order"_a);
  module.def(
    "stream_error",
    [](const nb::dict& parameters)
    { return StreamingReconstruction::errorOf(parametersOf(parameters)); },
    "parameters"_a);
  module.def(
    "errors", [](const nb::dict& parameters) { return parametersOf(parameters).errors(); },
    "parameters"_a);
  module.def("remeshing_error", &remeshingError, "parameters"_a, "beside"_a);
  module.def("sample_surface", &sampleSurface, "parameters"_a, "points"_a, "triangles"_a);
  module.def("empty_curve", [] { return curveOf(LearningCurve()); });
  module.def("grid_count", &Ensemble::gridCount, "resolution"_a);
  bindFiles(module);
  bindMeasures(module);
  bindRun(module);
  bindStream(module);
}
}
}
