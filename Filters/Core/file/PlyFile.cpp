// SPDX-License-Identifier: BSD-3-Clause
#include "file/PlyFile.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "cloud/PlyHeader.h"
#include "file/Bytes.h"
#include "file/InputFile.h"
#include "file/Words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
/// The values of a property in a record; of one that is no list there is one.
using PlyValues = std::vector<double>;

[[noreturn]] void throwLacks(const PlyElement& element)
{
  throw std::runtime_error("damaged: it ends before its last " + element.name);
}

/// A record a line.
class PlyTextRecords
{
public:
  explicit PlyTextRecords(std::string_view bytes)
    : bytes_(bytes)
  {
  }

  void begin(const PlyElement& element)
  {
    if (bytes_.empty())
    {
      throwLacks(element);
    }
    line_ = bytes_.substr(0, bytes_.find('\n'));
    bytes_.remove_prefix(std::min(line_.size() + 1, bytes_.size()));
  }
  double next(const PlyElement& element, PlyType)
  {
    double number = 0.;
    const std::string_view word = takeWord(line_);
    if (word.empty())
    {
      if (bytes_.empty())
      {
        throwLacks(element);
      }
      throw std::runtime_error("damaged: the line of a " + element.name + " is too short");
    }
    if (!parseNumber(word, number))
    {
      throw std::runtime_error("damaged: '" + oneLine(word) + "' is no number");
    }
    return number;
  }

private:
  std::string_view bytes_;
  std::string_view line_;
};

class PlyBinaryRecords
{
public:
  PlyBinaryRecords(std::string_view bytes, bool isBigEndian)
    : bytes_(bytes)
    , isBigEndian_(isBigEndian)
  {
  }

  void begin(const PlyElement&) {}
  double next(const PlyElement& element, PlyType type)
  {
    if (type.size > bytes_.size())
    {
      throwLacks(element);
    }
    const double number = type.numberAt(bytes_.data(), isBigEndian_);
    bytes_.remove_prefix(std::size_t(type.size));
    return number;
  }

private:
  std::string_view bytes_;
  bool isBigEndian_;
};

/// Calls `take` with the values of each record, a list of them for each property.
template <typename Records, typename Take>
void readPlyRecords(const PlyElement& element, Records& records, const Take& take)
{
  std::vector<PlyValues> record(element.properties.size());
  for (std::uint64_t i = 0; i < element.count && !record.empty(); ++i)
  {
    records.begin(element);
    for (std::size_t p = 0; p < record.size(); ++p)
    {
      const PlyProperty& property = element.properties[p];
      record[p].clear();
      const double count = property.countType ? records.next(element, *property.countType) : 1.;
      if (!(count >= 0.))
      {
        throw std::runtime_error("damaged: the length of a list is negative");
      }
      for (double k = 0.; k < count; ++k)
      {
        record[p].push_back(records.next(element, property.type));
      }
    }
    take(record);
  }
}

/// Which properties of the vertices are what.
class PlyVertices
{
public:
  PlyVertices(const PlyElement& element, FileContents& contents)
    : element_(element)
    , contents_(contents)
    , isTaken_(element.properties.size())
  {
    const auto coordinates = find({ "x", "y", "z" });
    if (!coordinates)
    {
      throw std::runtime_error("its vertices have no x, y and z");
    }
    coordinates_ = *coordinates;
    isDouble_ = std::any_of(coordinates_.begin(), coordinates_.end(),
      [&](std::size_t place) { return !element.properties[place].type.fitsFloat(); });
    normals_ = find({ "nx", "ny", "nz" });
    colors_ = find({ "red", "green", "blue" });
    for (std::size_t p = 0; p < isTaken_.size(); ++p)
    {
      if (!isTaken_[p] && !element.properties[p].countType)
      {
        arrays_.push_back(p);
        contents.arrays.push_back({ element.properties[p].name, 1, {} });
      }
    }
  }

  void take(const std::vector<PlyValues>& record)
  {
    for (const std::size_t place : coordinates_)
    {
      isDouble_ ? contents_.doubles.push_back(record[place].front())
                : contents_.floats.push_back(float(record[place].front()));
    }
    if (normals_)
    {
      const auto& [x, y, z] = *normals_;
      contents_.normals.emplace_back(
        float(record[x].front()), float(record[y].front()), float(record[z].front()));
    }
    if (colors_)
    {
      auto& color = contents_.colors.emplace_back();
      for (std::size_t i = 0; i < color.size(); ++i)
      {
        const std::size_t place = (*colors_)[i];
        const double scale = element_.properties[place].type.isReal() ? 255. : 1.;
        const double part = scale * record[place].front();
        color[i] = std::isfinite(part) ? std::uint8_t(std::lround(std::clamp(part, 0., 255.))) : 0;
      }
    }
    for (std::size_t i = 0; i < arrays_.size(); ++i)
    {
      contents_.arrays[i].values.push_back(record[arrays_[i]].front());
    }
  }

private:
  using Places = std::array<std::size_t, 3>;

  /// The places of three properties, which are then taken; none if one is missing.
  std::optional<Places> find(const std::array<const char*, 3>& names)
  {
    Places places{};
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const PlyProperty* property = element_.find(names[i]);
      if (!property || property->countType)
      {
        return std::nullopt;
      }
      places[i] = std::size_t(property - element_.properties.data());
    }
    for (const std::size_t place : places)
    {
      isTaken_[place] = true;
    }
    return places;
  }

  const PlyElement& element_;
  FileContents& contents_;
  std::vector<bool> isTaken_;
  Places coordinates_{};
  bool isDouble_ = false;
  std::optional<Places> normals_;
  std::optional<Places> colors_;
  std::vector<std::size_t> arrays_;
};

template <typename Records>
void readElements(const PlyHeader& header, Records records, FileContents& contents)
{
  bool hasVertices = false;
  std::vector<std::uint64_t> polygon;
  // Faces that stand before the vertices.
  std::vector<std::vector<std::uint64_t>> polygons;
  for (const PlyElement& element : header.elements)
  {
    const auto isCorners = [](const PlyProperty& property)
    {
      return property.countType &&
        (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    const auto corners =
      std::find_if(element.properties.begin(), element.properties.end(), isCorners);
    if (element.name == "vertex" && !hasVertices)
    {
      hasVertices = true;
      PlyVertices vertices(element, contents);
      readPlyRecords(element, records, [&](const auto& record) { vertices.take(record); });
    }
    else if (element.name == "face" && corners != element.properties.end())
    {
      const auto place = std::size_t(corners - element.properties.begin());
      readPlyRecords(element, records,
        [&](const auto& record)
        {
          polygon.clear();
          for (const double corner : record[place])
          {
            polygon.push_back(corner >= 0. && corner < 4294967296.
                ? std::uint64_t(corner)
                : std::numeric_limits<std::uint64_t>::max());
          }
          hasVertices ? contents.addPolygon(polygon, contents.size()) : polygons.push_back(polygon);
        });
    }
    else
    {
      readPlyRecords(element, records, [](const auto&) {});
    }
  }
  if (!hasVertices)
  {
    throw std::runtime_error("there are no vertices in it");
  }
  for (const auto& early : polygons)
  {
    contents.addPolygon(early, contents.size());
  }
}

std::string plyHeaderOf(const FileContents& contents)
{
  const std::string type = contents.floats.empty() ? "double" : "float";
  std::string header = "ply\nformat binary_little_endian 1.0\n";
  if (contents.shift)
  {
    header += "comment " + commentOfShift(*contents.shift) + "\n";
  }
  header += "element vertex " + std::to_string(contents.size()) + "\n";
  for (const char* axis : { "x", "y", "z" })
  {
    header.append("property ").append(type).append(" ").append(axis).append("\n");
  }
  if (!contents.normals.empty())
  {
    header += "property float nx\nproperty float ny\nproperty float nz\n";
  }
  if (!contents.colors.empty())
  {
    header += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  }
  return header + "element face " + std::to_string(contents.triangles.size()) +
    "\nproperty list uchar int vertex_indices\nend_header\n";
}
}

FileContents readPly(const std::string& path)
{
  InputFile file(path);
  const std::string bytes = file.rest();
  const PlyHeader header = readPlyHeader(std::string_view(bytes).substr(0, LongestHeader));
  const std::string_view records = std::string_view(bytes).substr(std::size_t(header.size));
  FileContents contents;
  for (const std::string& comment : header.comments)
  {
    contents.shift = contents.shift ? contents.shift : shiftOfComment(comment);
  }
  if (header.isText)
  {
    readElements(header, PlyTextRecords(records), contents);
  }
  else
  {
    readElements(header, PlyBinaryRecords(records, header.isBigEndian), contents);
  }
  return contents;
}

std::string plyOf(const FileContents& contents)
{
  std::string bytes = plyHeaderOf(contents);
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    contents.floats.empty() ? appendBytes(bytes, &contents.doubles[3 * i], 3)
                            : appendBytes(bytes, &contents.floats[3 * i], 3);
    if (!contents.normals.empty())
    {
      appendBytes(bytes, contents.normals[i].data(), 3);
    }
    if (!contents.colors.empty())
    {
      appendBytes(bytes, contents.colors[i].data(), 3);
    }
  }
  for (const auto& triangle : contents.triangles)
  {
    bytes += '\3';
    appendBytes(bytes, triangle.data(), triangle.size());
  }
  return bytes;
}
}
