// SPDX-License-Identifier: BSD-3-Clause
// NumPy arrays as the engine takes them, and what it gives as NumPy arrays.
#pragma once

#include "cloud/PointSpans.h"
#include "mesh/TriangleMesh.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace neuralmesh::binding
{
/// An array in the memory of its owner, which it refers to and does not change.
using AnyArray = nanobind::ndarray<nanobind::ro, nanobind::device::cpu, nanobind::c_contig>;
template <typename Value>
using ArrayOf = nanobind::ndarray<const Value, nanobind::device::cpu, nanobind::c_contig>;

template <typename Value>
std::span<const Value> valuesOf(const ArrayOf<Value>& array)
{
  return { array.data(), array.size() };
}

/// Arrays of shape (N, 3) of 4- or 8-byte floats as one cloud; nothing is copied. Throws
/// std::invalid_argument for other arrays.
PointSpans spansOf(const std::vector<AnyArray>& arrays);
/// Places, one a row.
std::vector<Eigen::Vector3d> placesOf(const ArrayOf<double>& array);
/// Points of shape (N, 3) and triangles of shape (T, 3). Throws std::invalid_argument where a triangle
/// refers to a point that is not there.
TriangleMesh meshOf(const ArrayOf<double>& points, const ArrayOf<std::int64_t>& triangles);

/// The values as an array that owns them, in rows of so many; 0: they are one row.
template <typename Value>
nanobind::object arrayOf(std::vector<Value> values, std::size_t columns = 0)
{
  auto* kept = new std::vector<Value>(std::move(values));
  const nanobind::capsule owner(
    kept, [](void* vector) noexcept { delete static_cast<std::vector<Value>*>(vector); });
  if (columns == 0)
  {
    return nanobind::cast(nanobind::ndarray<nanobind::numpy, Value, nanobind::ndim<1>>(
      kept->data(), { kept->size() }, owner));
  }
  return nanobind::cast(nanobind::ndarray<nanobind::numpy, Value, nanobind::ndim<2>>(
    kept->data(), { kept->size() / columns, columns }, owner));
}

/// Vectors as an array of shape (N, 3), in other numbers if those are wanted.
template <typename Value>
nanobind::object rowsOf(const std::vector<Eigen::Vector3d>& vectors)
{
  std::vector<Value> values;
  values.reserve(3 * vectors.size());
  for (const Eigen::Vector3d& vector : vectors)
  {
    for (const double coordinate : vector)
    {
      values.push_back(Value(coordinate));
    }
  }
  return arrayOf(std::move(values), 3);
}

/// The triangles as an array of shape (T, 3).
nanobind::object trianglesOf(const TriangleMesh& mesh);
}
