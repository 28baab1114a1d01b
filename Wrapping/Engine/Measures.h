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

/// What a run will take: bytes, samples and seconds, from rows of iterations, vertices and seconds.
std::tuple<double, double, double> estimate(double vertices, double points, double bytesOfPoints,
  double samplesForFeatures, bool isEnsemble, const ArrayOf<double>& growth, double secondsOfTrial);
}
