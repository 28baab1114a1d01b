// SPDX-License-Identifier: BSD-3-Clause
#include "Files.h"

#include "ReadingGuard.h"

#include "base/AtomicFile.h"
#include "cloud/PlyContents.h"
#include "file/JoinedViews.h"
#include "file/ReadFile.h"
#include "file/WriteMesh.h"

#include <algorithm>
#include <stdexcept>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
/// Of so many points, or a few more, spread over all of them.
constexpr std::size_t PointsToLookAt = 100000;

Eigen::Vector3d vectorOf(const Vector& vector)
{
  return { std::get<0>(vector), std::get<1>(vector), std::get<2>(vector) };
}

Vector tupleOf(const Eigen::Vector3d& vector) { return { vector.x(), vector.y(), vector.z() }; }

/// What the core says is about what it was given. To be called without Python's lock.
template <typename Use>
auto asBadInput(const Use& use)
{
  try
  {
    return use();
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(error.what());
  }
}

/// Rows of values that are one behind the other in a vector of arrays, which the result owns.
template <typename Value, typename Row>
nb::object rowsOfArrays(std::vector<Row> rows)
{
  static_assert(sizeof(Row) == 3 * sizeof(Value));
  auto* kept = new std::vector<Row>(std::move(rows));
  const nb::capsule owner(
    kept, [](void* vector) noexcept { delete static_cast<std::vector<Row>*>(vector); });
  return nb::cast(nb::ndarray<nb::numpy, Value, nb::ndim<2>>(
    reinterpret_cast<Value*>(kept->data()), { kept->size(), 3 }, owner));
}

CoordinateRange rangeOfArray(const AnyArray& points)
{
  const PointSpans spans = spansOf({ points });
  const std::size_t step = 1 + spans.size() / PointsToLookAt;
  std::vector<Eigen::Vector3d> some;
  for (std::size_t i = 0; i < spans.size(); i += step)
  {
    some.push_back(spans[i]);
  }
  return CoordinateRange(some);
}

FileContents contentsOf(const AnyArray& points, const ArrayOf<std::int64_t>& triangles,
  const std::optional<ArrayOf<float>>& normals, const std::optional<ArrayOf<std::uint8_t>>& colors)
{
  if (triangles.ndim() != 2 || triangles.shape(1) != 3)
  {
    throw std::invalid_argument("triangles are an array of shape (T, 3)");
  }
  FileContents contents;
  const std::size_t count = spansOf({ points }).size();
  if (points.dtype() == nb::dtype<float>())
  {
    const auto* values = static_cast<const float*>(points.data());
    contents.floats.assign(values, values + 3 * count);
  }
  else
  {
    const auto* values = static_cast<const double*>(points.data());
    contents.doubles.assign(values, values + 3 * count);
  }
  contents.triangles.resize(triangles.size() / 3);
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    const std::int64_t corner = triangles.data()[i];
    // What is no point is refused by the writer.
    const bool isNumber = corner >= 0 && corner < UINT32_MAX;
    contents.triangles[i / 3][i % 3] = isNumber ? std::uint32_t(corner) : UINT32_MAX;
  }
  for (std::size_t i = 0; normals && i + 2 < normals->size(); i += 3)
  {
    contents.normals.emplace_back(normals->data() + i);
  }
  for (std::size_t i = 0; colors && i + 2 < colors->size(); i += 3)
  {
    const std::uint8_t* color = colors->data() + i;
    contents.colors.push_back({ color[0], color[1], color[2] });
  }
  return contents;
}
}

nb::dict readPoints(const std::string& path)
{
  FileContents contents;
  {
    const nb::gil_scoped_release unlocked;
    contents = asBadInput([&] { return readFile(path); });
  }
  nb::dict result;
  result["points"] = contents.doubles.empty() ? arrayOf(std::move(contents.floats), 3)
                                              : arrayOf(std::move(contents.doubles), 3);
  result["triangles"] = rowsOfArrays<std::uint32_t>(std::move(contents.triangles));
  if (!contents.normals.empty())
  {
    result["normals"] = rowsOfArrays<float>(std::move(contents.normals));
  }
  if (!contents.colors.empty())
  {
    result["colors"] = rowsOfArrays<std::uint8_t>(std::move(contents.colors));
  }
  if (!contents.viewpoints.empty())
  {
    result["viewpoints"] = rowsOfArrays<double>(std::move(contents.viewpoints));
  }
  if (!contents.views.empty())
  {
    result["views"] = arrayOf(std::move(contents.views));
  }
  nb::dict arrays;
  for (NumberArray& array : contents.arrays)
  {
    const std::size_t columns = array.components == 1 ? 0 : array.components;
    arrays[array.name.c_str()] = arrayOf(std::move(array.values), columns);
  }
  result["arrays"] = arrays;
  result["missing_returns"] = contents.missingReturns;
  result["remark"] = contents.remark;
  return result;
}

nb::object readGuarded(const std::string& path, const nb::callable& read)
{
  const ReadingGuard guard(path);
  return read(path);
}

Vector writeSurface(const std::string& path, const AnyArray& points,
  const ArrayOf<std::int64_t>& triangles, const std::optional<ArrayOf<float>>& normals,
  const std::optional<ArrayOf<std::uint8_t>>& colors, std::optional<Vector> shift, Vector noted)
{
  FileContents contents = contentsOf(points, triangles, normals, colors);
  contents.shift = vectorOf(noted);
  WritingOptions options;
  options.isShiftAutomatic = !shift;
  options.shift = vectorOf(shift.value_or(Vector()));
  const nb::gil_scoped_release unlocked;
  return asBadInput([&] { return tupleOf(writeMesh(path, contents, options)); });
}

void requireDigitsFor(
  const std::string& path, const AnyArray& points, std::size_t vertices, Vector shift)
{
  const CoordinateRange range = rangeOfArray(points);
  asBadInput([&] { requireDigits(path, range, vertices, vectorOf(shift)); });
}

Vector roundShiftOf(const AnyArray& points)
{
  return tupleOf(rangeOfArray(points).roundShift(spansOf({ points }).size()));
}

std::string noteOf(Vector shift) { return commentOfShift(vectorOf(shift)); }

void requirePlace(const std::string& path)
{
  asBadInput([&] { requireWritablePlace(path); });
}

void writeWhole(const std::string& path, const nb::bytes& content)
{
  const std::string bytes(content.c_str(), content.size());
  const nb::gil_scoped_release unlocked;
  asBadInput([&]
    { writeAtomicFile(path, [&](const std::string& temporary) { writeText(bytes, temporary); }); });
}

nb::dict joinViews(
  const std::vector<std::tuple<std::size_t, ArrayOf<double>, ArrayOf<std::uint32_t>>>& parts)
{
  std::vector<FileViews> files;
  for (const auto& [points, viewpoints, views] : parts)
  {
    const std::span<const std::uint32_t> numbers = valuesOf(views);
    files.push_back({ points, placesOf(viewpoints), { numbers.begin(), numbers.end() } });
  }
  FileViews joined = joinedViews(files);
  nb::dict result;
  result["viewpoints"] = rowsOf<double>(joined.viewpoints);
  result["views"] = arrayOf(std::move(joined.views));
  return result;
}
}
