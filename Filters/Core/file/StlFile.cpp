// SPDX-License-Identifier: BSD-3-Clause
#include "file/StlFile.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "file/Bytes.h"
#include "file/InputFile.h"
#include "file/Words.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <unordered_map>

namespace neuralmesh
{
namespace
{
constexpr std::size_t TitleSize = 80, StlHeaderSize = 84, StlTriangleSize = 50;

using StlCorner = std::array<std::uint64_t, 3>;

struct StlCornerHash
{
  std::size_t operator()(const StlCorner& corner) const
  {
    std::uint64_t hash = 0;
    for (const std::uint64_t bits : corner)
    {
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    return std::size_t(hash);
  }
};

/// Makes one point of equal corners.
class MergedCorners
{
public:
  explicit MergedCorners(FileContents& contents)
    : contents_(contents)
  {
  }

  template <typename Number>
  void add(const std::array<Number, 3>& point)
  {
    StlCorner corner{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // 0 and -0 are equal.
      corner[axis] = std::bit_cast<std::uint64_t>(double(point[axis] + Number(0)));
    }
    const auto [place, isNew] = indices_.try_emplace(corner, std::uint32_t(indices_.size()));
    if (isNew)
    {
      coordinates<Number>().insert(coordinates<Number>().end(), point.begin(), point.end());
      if (indices_.size() == std::numeric_limits<std::uint32_t>::max())
      {
        throw std::runtime_error("there are too many points in it");
      }
    }
    polygon_.push_back(place->second);
  }

  /// Ends a polygon.
  void close()
  {
    for (std::size_t i = 2; i < polygon_.size(); ++i)
    {
      const std::array<std::uint32_t, 3> triangle{ polygon_[0], polygon_[i - 1], polygon_[i] };
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] && triangle[2] != triangle[0])
      {
        contents_.triangles.push_back(triangle);
      }
    }
    polygon_.clear();
  }
  std::size_t cornersOfPolygon() const { return polygon_.size(); }

private:
  template <typename Number>
  std::vector<Number>& coordinates()
  {
    if constexpr (std::is_same_v<Number, float>)
    {
      return contents_.floats;
    }
    else
    {
      return contents_.doubles;
    }
  }

  FileContents& contents_;
  std::unordered_map<StlCorner, std::uint32_t, StlCornerHash> indices_;
  std::vector<std::uint32_t> polygon_;
};

void readBinaryStl(const std::string& bytes, std::uint64_t triangles, FileContents& contents)
{
  std::string title = bytes.substr(0, TitleSize);
  title.resize(std::min(title.find('\0'), title.size()));
  contents.shift = shiftOfComment(title);
  MergedCorners corners(contents);
  for (std::uint64_t i = 0; i < triangles; ++i)
  {
    const char* place = bytes.data() + StlHeaderSize + i * StlTriangleSize;
    for (int k = 0; k < 3; ++k)
    {
      // Behind the normal.
      place += sizeof(std::array<float, 3>);
      std::array<float, 3> point{};
      std::memcpy(point.data(), place, sizeof point);
      corners.add(point);
    }
    corners.close();
  }
}

void readTextStl(InputFile& file, FileContents& contents)
{
  MergedCorners corners(contents);
  bool isOpen = false;
  while (file.nextFilledLine())
  {
    std::string_view line = file.line();
    std::string word(takeWord(line));
    std::transform(word.begin(), word.end(), word.begin(),
      [](unsigned char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : char(c); });
    if (word == "solid" && !isOpen)
    {
      isOpen = true;
    }
    else if (!isOpen)
    {
      throw file.errorInLine("this is no .stl: " + oneLine(file.line()));
    }
    else if (word == "vertex")
    {
      std::array<double, 3> point{};
      if (!takeNumbers(line, 3, point.data()))
      {
        throw file.errorInLine("damaged: this is no corner: " + oneLine(file.line()));
      }
      corners.add(point);
    }
    else if (word == "endloop")
    {
      if (corners.cornersOfPolygon() < 3)
      {
        throw file.errorInLine("damaged: a triangle has fewer than three corners");
      }
      corners.close();
    }
    else if (word == "endsolid")
    {
      isOpen = false;
    }
  }
  if (isOpen || contents.size() == 0)
  {
    throw file.error(isOpen ? "damaged: it ends before its endsolid" : "there is no solid in it");
  }
}

}

FileContents readStl(const std::string& path)
{
  FileContents contents;
  InputFile binary(path);
  const std::string bytes = binary.rest();
  std::uint32_t triangles = 0;
  if (bytes.size() >= StlHeaderSize)
  {
    std::memcpy(&triangles, bytes.data() + TitleSize, sizeof triangles);
  }
  const std::uint64_t needed = StlHeaderSize + StlTriangleSize * std::uint64_t(triangles);
  const bool hasNull =
    std::string_view(bytes).substr(0, StlHeaderSize).find('\0') != std::string_view::npos;
  if (hasNull && (bytes.size() < StlHeaderSize || bytes.size() < needed))
  {
    throw binary.error("damaged: it ends before its last triangle");
  }
  if (hasNull || (bytes.size() >= StlHeaderSize && bytes.size() == needed))
  {
    readBinaryStl(bytes, triangles, contents);
  }
  else
  {
    InputFile text(path);
    readTextStl(text, contents);
  }
  return contents;
}

std::string stlOf(const FileContents& contents)
{
  std::string bytes = contents.shift ? commentOfShift(*contents.shift) : "";
  if (bytes.size() > TitleSize)
  {
    throw std::runtime_error("the shift is too long for the title of an .stl");
  }
  bytes.resize(TitleSize, '\0');
  const auto count = std::uint32_t(contents.triangles.size());
  appendBytes(bytes, &count, 1);
  bytes.reserve(StlHeaderSize + StlTriangleSize * contents.triangles.size());
  const PointSpans points = contents.points();
  for (const auto& [a, b, c] : contents.triangles)
  {
    const Eigen::Vector3d origin = points[a];
    const Eigen::Vector3f normal =
      (points[b] - origin).cross(points[c] - origin).stableNormalized().cast<float>();
    appendBytes(bytes, normal.data(), 3);
    for (const std::uint32_t corner : { a, b, c })
    {
      const Eigen::Vector3f point = points[corner].cast<float>();
      appendBytes(bytes, point.data(), 3);
    }
    bytes.append(2, '\0');
  }
  return bytes;
}
}
