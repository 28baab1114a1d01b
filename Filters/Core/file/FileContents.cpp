// SPDX-License-Identifier: BSD-3-Clause
#include "file/FileContents.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace neuralmesh
{
PointSpans FileContents::points() const
{
  PointSpans spans;
  spans.add(std::span(floats));
  spans.add(std::span(doubles));
  return spans;
}

void FileContents::addPoint(const Eigen::Vector3d& point)
{
  doubles.insert(doubles.end(), point.begin(), point.end());
}

void FileContents::addPolygon(const std::vector<std::uint64_t>& corners, std::size_t points)
{
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  const std::uint64_t end = std::min<std::uint64_t>(points, most);
  if (std::any_of(corners.begin(), corners.end(), [end](auto corner) { return corner >= end; }))
  {
    throw std::runtime_error("damaged: a polygon has a point that does not exist");
  }
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    triangles.push_back(
      { std::uint32_t(corners[0]), std::uint32_t(corners[i - 1]), std::uint32_t(corners[i]) });
  }
}

void FileContents::move(const Eigen::Vector3d& vector)
{
  doubles.insert(doubles.end(), floats.begin(), floats.end());
  std::vector<float>().swap(floats);
  for (std::size_t i = 0; i < doubles.size(); ++i)
  {
    doubles[i] += vector[Eigen::Index(i % 3)];
  }
}
}
