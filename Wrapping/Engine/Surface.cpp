// SPDX-License-Identifier: BSD-3-Clause
#include "Surface.h"

#include "Values.h"

#include "mesh/ManifoldSurface.h"
#include "mesh/SurfaceSamples.h"
#include "run/Remeshing.h"

#include <optional>
#include <stdexcept>

namespace nb = nanobind;

namespace neuralmesh::binding
{
std::string remeshingError(const nb::dict& parameters, const nb::dict& beside)
{
  const auto isThere = [&](const char* name)
  { return beside.contains(name) && nb::cast<bool>(beside[name]); };
  return whyNoRemeshing(parametersOf(parameters),
    { .points = isThere("points"),
      .firstMesh = isThere("first_mesh"),
      .weights = isThere("weights"),
      .sides = isThere("sides"),
      .size = isThere("size"),
      .levels = isThere("levels"),
      .checkpoint = isThere("checkpoint"),
      .snapshots = isThere("snapshots"),
      .automatic = isThere("automatic"),
      .explanation = isThere("explanation"),
      .estimate = isThere("estimate") });
}

nb::dict sampleSurface(
  const nb::dict& parameters, const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles)
{
  const Parameters values = parametersOf(parameters);
  std::optional<TriangleMesh> input;
  try
  {
    input = meshOf(points, triangles);
  }
  catch (const std::invalid_argument& error)
  {
    throw std::invalid_argument(std::string("The input is no surface: ") + error.what() + ".");
  }
  ManifoldSurface surface;
  SurfaceSamples samples;
  {
    const nb::gil_scoped_release unlocked;
    try
    {
      surface = manifoldOf(*input);
      samples = neuralmesh::sampleSurface(*input, surface, samplesOfSurface(values), values.seed);
    }
    catch (const std::runtime_error& error)
    {
      throw std::invalid_argument(error.what());
    }
  }
  std::vector<float> normals;
  normals.reserve(3 * samples.normals.size());
  for (const Eigen::Vector3f& normal : samples.normals)
  {
    normals.insert(normals.end(), normal.begin(), normal.end());
  }
  std::vector<double> weights;
  weights.reserve(3 * samples.weights.size());
  for (const auto& corners : samples.weights)
  {
    weights.insert(weights.end(), corners.begin(), corners.end());
  }
  nb::dict result;
  result["points"] = rowsOf<double>(samples.points);
  result["normals"] = arrayOf(std::move(normals), 3);
  result["triangles"] = arrayOf(std::move(samples.triangles));
  result["weights"] = arrayOf(std::move(weights), 3);
  result["surface_points"] = rowsOf<double>(surface.mesh.points);
  result["surface_triangles"] = trianglesOf(surface.mesh);
  result["warning"] = warningOfSurface(surface);
  return result;
}
}
