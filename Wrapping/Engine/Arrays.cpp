// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.h"

#include <stdexcept>
#include <string>

namespace nb = nanobind;

namespace neuralmesh::binding
{
PointSpans spansOf(const std::vector<AnyArray>& arrays)
{
  PointSpans spans;
  for (const AnyArray& array : arrays)
  {
    const bool isFloat = array.dtype() == nb::dtype<float>();
    if ((!isFloat && array.dtype() != nb::dtype<double>()) || array.ndim() != 2 ||
      array.shape(1) != 3)
    {
      throw std::invalid_argument("points are arrays of shape (N, 3) of 4- or 8-byte floats");
    }
    if (array.size() == 0)
    {
      continue;
    }
    if (isFloat)
    {
      spans.add(std::span(static_cast<const float*>(array.data()), array.size()));
    }
    else
    {
      spans.add(std::span(static_cast<const double*>(array.data()), array.size()));
    }
  }
  return spans;
}

std::vector<Eigen::Vector3d> placesOf(const ArrayOf<double>& array)
{
  std::vector<Eigen::Vector3d> places(array.size() / 3);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    places[i] = Eigen::Vector3d(array.data() + 3 * i);
  }
  return places;
}

TriangleMesh meshOf(const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles)
{
  const auto hasThreeColumns = [](const auto& array)
  { return array.ndim() == 2 && array.shape(1) == 3; };
  if (!hasThreeColumns(points) || !hasThreeColumns(triangles))
  {
    throw std::invalid_argument(
      "points and triangles of a mesh are arrays of shape (N, 3) and (T, 3)");
  }
  TriangleMesh mesh{ placesOf(points), {} };
  if (mesh.points.size() > UINT32_MAX)
  {
    throw std::invalid_argument("there are more than 4294967295 points");
  }
  mesh.triangles.resize(triangles.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const std::int64_t corner = triangles.data()[i];
    if (corner < 0 || std::size_t(corner) >= mesh.points.size())
    {
      throw std::invalid_argument("a cell refers to point " + std::to_string(corner) +
        ", but there are only " + std::to_string(mesh.points.size()));
    }
    mesh.triangles[i / 3][i % 3] = std::uint32_t(corner);
  }
  return mesh;
}

nb::object trianglesOf(const TriangleMesh& mesh)
{
  std::vector<std::int64_t> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles)
  {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return arrayOf(std::move(corners), 3);
}
}
