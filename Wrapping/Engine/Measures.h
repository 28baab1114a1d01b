// SPDX-License-Identifier: BSD-3-Clause
// What is told of meshes that are there: comparison, explanation, report.
#pragma once

#include "Arrays.h"
#include "Call.h"

#include <cstdint>
#include <tuple>

namespace neuralmesh::binding
{
/// The figures of both directions and of both ways together, the distances of the points of both, and the
/// diagonal; None if it was ended. Throws std::invalid_argument where a surface has no area.
nanobind::object compare(
  TriangleMesh reference, TriangleMesh result, std::size_t samples, std::uint64_t seed, Call& call);

/// `Distance` and `Reason` of each point, and field data; None if it was ended. Throws
/// std::invalid_argument where no point or no triangle can be used.
nanobind::object explain(
  const std::vector<AnyArray>& points, TriangleMesh mesh, double leastPiece, Call& call);

/// What can be said of a mesh by itself: a dict of numbers, by the names that `info --json` has.
nanobind::dict report(TriangleMesh mesh);

/// What a run will take, as lines of a report. `plan` has the names of PlannedRun, and `trial` and `start`, which may be
/// empty, are a dict each of vertices, growth (rows of iterations, vertices and seconds) and the times of TrialRun.
std::string estimate(const nanobind::dict& plan, const nanobind::dict& trial,
  const nanobind::dict& start, double wallSeconds);

/// Vertices that such a run learns.
double learntVertices(const nanobind::dict& plan);
}
