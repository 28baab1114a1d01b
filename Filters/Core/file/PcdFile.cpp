// SPDX-License-Identifier: BSD-3-Clause
#include "file/PcdFile.h"

#include "base/OneLine.h"
#include "cloud/PlyHeader.h"
#include "file/GridCamera.h"
#include "file/InputFile.h"
#include "file/Lzf.h"
#include "file/Words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <span>

namespace neuralmesh
{
namespace
{
constexpr std::string_view PcdPadding = "_";
constexpr std::array<std::string_view, 3> CoordinateFields{ "x", "y", "z" };
constexpr std::array<std::string_view, 3> NormalFields{ "normal_x", "normal_y", "normal_z" };
constexpr PlyType PackedColor{ 4, PlyType::Kind::Unsigned };

struct PcdField
{
  std::string name;
  PlyType type;
  std::uint64_t count = 1;
  std::uint64_t offset = 0; ///< bytes in a record before it
  std::size_t first = 0;    ///< numbers in a record before it
  bool isColor() const { return (name == "rgb" || name == "rgba") && type.size == 4 && count == 1; }
};

struct PcdHeader
{
  std::vector<PcdField> fields;
  std::uint64_t points = 0;
  std::uint64_t columns = 0;
  std::uint64_t stride = 0; ///< bytes of a record
  std::size_t numbers = 0;  ///< of a record
  std::optional<Eigen::Vector3d> viewpoint;
  std::string encoding;

  const PcdField* find(std::string_view name) const
  {
    const auto found = std::find_if(fields.begin(), fields.end(),
      [name](const PcdField& field) { return field.name == name && field.count == 1; });
    return found == fields.end() ? nullptr : &*found;
  }
};

using PcdLines = std::map<std::string, std::string, std::less<>>;

/// The lines before the data, by their first words.
PcdLines readHeaderLines(InputFile& file)
{
  static constexpr std::array<std::string_view, 10> known{ "VERSION", "FIELDS", "COLUMNS", "SIZE",
    "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS" };
  PcdLines lines;
  while (file.nextFilledLine())
  {
    std::string_view line = file.line();
    std::string word(takeWord(line));
    if (word != "DATA" && std::find(known.begin(), known.end(), word) == known.end())
    {
      throw file.errorInLine("this is no line of a .pcd: " + oneLine(file.line()));
    }
    word = word == "COLUMNS" ? "FIELDS" : word;
    lines[word] = line;
    if (word == "DATA")
    {
      return lines;
    }
  }
  throw file.error("damaged: its header does not end");
}

std::uint64_t countIn(const InputFile& file, const PcdLines& lines, const std::string& name)
{
  const auto line = lines.find(name);
  std::string_view words = line == lines.end() ? std::string_view() : line->second;
  std::uint64_t count = 0;
  if (!parseCount(takeWord(words), count))
  {
    throw file.error("damaged: its header has no number behind " + name);
  }
  return count;
}

PlyType pcdTypeOf(const InputFile& file, std::string_view letter, std::uint64_t size)
{
  using enum PlyType::Kind;
  const PlyType type{ size, letter == "F" ? Real : letter == "U" ? Unsigned : Signed };
  const bool isKnown = (letter == "F" && (size == 4 || size == 8)) ||
    ((letter == "I" || letter == "U") && (size == 1 || size == 2 || size == 4 || size == 8));
  if (!isKnown)
  {
    throw file.error("damaged: a field is of no type and size that there are");
  }
  return type;
}

void readPcdFields(const InputFile& file, const PcdLines& lines, PcdHeader& header)
{
  const auto wordsBehind = [&](const std::string& name)
  {
    const auto line = lines.find(name);
    return line == lines.end() ? std::vector<std::string_view>() : wordsOf(line->second);
  };
  const auto names = wordsBehind("FIELDS"), sizes = wordsBehind("SIZE"),
             types = wordsBehind("TYPE"), counts = wordsBehind("COUNT");
  if (names.empty() || sizes.size() != names.size() || types.size() != names.size() ||
    (!counts.empty() && counts.size() != names.size()))
  {
    throw file.error("damaged: its header does not have a name, a size and a type of each field");
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    PcdField field{ std::string(names[i]), {}, 1, header.stride, header.numbers };
    std::uint64_t size = 0;
    if (!parseCount(sizes[i], size) || size == 0 ||
      (!counts.empty() && !parseCount(counts[i], field.count)))
    {
      throw file.error("damaged: a size or a count of its fields is no number");
    }
    // What is only there to fill may be of any size.
    field.type = names[i] == PcdPadding ? PlyType{ size, PlyType::Kind::Signed }
                                        : pcdTypeOf(file, types[i], size);
    header.stride = behind(header.stride, field.count, size);
    header.numbers = std::size_t(behind(header.numbers, field.count, 1));
    header.fields.push_back(field);
  }
}

void readPcdViewpoint(const InputFile& file, const PcdLines& lines, PcdHeader& header)
{
  const auto line = lines.find("VIEWPOINT");
  if (line == lines.end())
  {
    return;
  }
  std::array<double, 7> pose{};
  std::string_view words = line->second;
  if (!takeNumbers(words, pose.size(), pose.data()))
  {
    throw file.error("damaged: its VIEWPOINT is not seven numbers");
  }
  constexpr std::array<double, 7> unknown{ 0., 0., 0., 1., 0., 0., 0. };
  const Eigen::Vector3d place(pose.data());
  if (pose != unknown && place.allFinite())
  {
    header.viewpoint = place;
  }
}

PcdHeader readPcdHeader(InputFile& file)
{
  const PcdLines lines = readHeaderLines(file);
  PcdHeader header;
  readPcdFields(file, lines, header);
  readPcdViewpoint(file, lines, header);
  const bool hasPoints = lines.contains("POINTS"), hasHeight = lines.contains("HEIGHT");
  header.columns = countIn(file, lines, "WIDTH");
  header.points = behind(0, header.columns, hasHeight ? countIn(file, lines, "HEIGHT") : 1);
  if (hasPoints && countIn(file, lines, "POINTS") != header.points)
  {
    throw file.error("damaged: its POINTS are not WIDTH times HEIGHT");
  }
  for (const std::string_view axis : CoordinateFields)
  {
    if (!header.find(axis))
    {
      throw file.error("its points have no " + std::string(axis));
    }
  }
  std::string_view encoding = lines.at("DATA");
  header.encoding = takeWord(encoding);
  return header;
}

/// Makes points of records.
class PcdPoints
{
public:
  PcdPoints(const PcdHeader& header, FileContents& contents)
    : header_(header)
    , contents_(contents)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const PcdField* coordinate = header.find(CoordinateFields[axis]);
      coordinates_[axis] = coordinate->first;
      isDouble_ = isDouble_ || !coordinate->type.fitsFloat();
      if (const PcdField* normal = header.find(NormalFields[axis]))
      {
        normals_.push_back(normal->first);
      }
    }
    for (const PcdField& field : header.fields)
    {
      const auto isOneOf = [&field](const auto& names)
      { return std::find(names.begin(), names.end(), field.name) != names.end(); };
      if (field.isColor() && !color_)
      {
        color_ = field.first;
      }
      else if (field.name != PcdPadding && field.count > 0 && !isOneOf(CoordinateFields) &&
        !(normals_.size() == 3 && isOneOf(NormalFields)))
      {
        arrays_.push_back(field.first);
        contents.arrays.push_back({ field.name, std::size_t(field.count), {} });
      }
    }
  }

  /// Takes the numbers of a record.
  void take(std::span<const double> record)
  {
    for (const std::size_t place : coordinates_)
    {
      isDouble_ ? contents_.doubles.push_back(record[place])
                : contents_.floats.push_back(float(record[place]));
    }
    if (normals_.size() == 3)
    {
      contents_.normals.emplace_back(
        float(record[normals_[0]]), float(record[normals_[1]]), float(record[normals_[2]]));
    }
    if (color_)
    {
      const auto packed = std::uint32_t(record[*color_]);
      contents_.colors.push_back(
        { std::uint8_t(packed >> 16), std::uint8_t(packed >> 8), std::uint8_t(packed) });
    }
    for (std::size_t i = 0; i < arrays_.size(); ++i)
    {
      NumberArray& array = contents_.arrays[i];
      const auto first = record.begin() + std::ptrdiff_t(arrays_[i]);
      array.values.insert(array.values.end(), first, first + std::ptrdiff_t(array.components));
    }
  }

private:
  const PcdHeader& header_;
  FileContents& contents_;
  bool isDouble_ = false;
  std::array<std::size_t, 3> coordinates_{}; ///< places in the record
  std::vector<std::size_t> normals_;
  std::optional<std::size_t> color_;
  std::vector<std::size_t> arrays_;
};

/// Sets where the points were seen from: the camera of a depth image, which saw all of them, or what the file tells.
void setViewpoint(const PcdHeader& header, FileContents& contents)
{
  const std::uint64_t rows = header.columns > 0 ? header.points / header.columns : 0;
  const std::optional<Eigen::Vector3d> camera =
    cameraOf({ std::size_t(header.columns), std::size_t(rows),
      [&](std::size_t i) -> Eigen::Vector3d
      {
        return contents.doubles.empty()
          ? Eigen::Map<const Eigen::Vector3f>(contents.floats.data() + 3 * i).cast<double>()
          : Eigen::Vector3d(contents.doubles.data() + 3 * i);
      } });
  if (camera)
  {
    contents.viewpoints = { *camera };
    contents.views.assign(contents.size(), 0);
  }
  else if (header.viewpoint)
  {
    contents.viewpoints = { *header.viewpoint };
  }
}

/// A colour in text: the number of its bytes, or the float that has these bytes.
double pcdColorOf(double number, PlyType type)
{
  if (type.isReal())
  {
    return double(std::bit_cast<std::uint32_t>(float(number)));
  }
  return number >= 0. && number < 4294967296. ? number : 0.;
}

void readPcdText(InputFile& file, const PcdHeader& header, PcdPoints& points)
{
  // Each number takes a byte and a blank; fields may claim anything.
  if (header.points > 0 && header.numbers > file.size())
  {
    throw file.error("damaged: it ends before its last point");
  }
  std::vector<double> record(header.points > 0 ? header.numbers : 0);
  for (std::uint64_t i = 0; i < header.points; ++i)
  {
    if (!file.nextFilledLine())
    {
      throw file.error("damaged: it ends before its last point");
    }
    std::string_view line = file.line();
    for (const PcdField& field : header.fields)
    {
      double* const place = record.data() + field.first;
      if (!takeNumbers(line, std::size_t(field.count), place) && field.name != PcdPadding)
      {
        throw file.errorInLine("damaged: there is no number for " + oneLine(field.name));
      }
      if (field.isColor())
      {
        *place = pcdColorOf(*place, field.type);
      }
    }
    points.take(record);
  }
}

/// Of bytes in which the numbers of a field lie `strideOf(field)` apart, from `placeOf(field)` on.
template <typename PlaceOf, typename StrideOf>
void readPcdRecords(const std::string& bytes, const PcdHeader& header, PcdPoints& points,
  const PlaceOf& placeOf, const StrideOf& strideOf)
{
  std::vector<double> record(header.points > 0 ? header.numbers : 0);
  for (std::uint64_t i = 0; i < header.points; ++i)
  {
    for (const PcdField& field : header.fields)
    {
      // A float may not keep the bits of a colour that are no number.
      const PlyType type = field.isColor() ? PackedColor : field.type;
      const char* place = bytes.data() + placeOf(field) + i * strideOf(field);
      for (std::uint64_t k = 0; k < field.count && field.name != PcdPadding; ++k)
      {
        record[field.first + k] = type.numberAt(place + k * type.size, false);
      }
    }
    points.take(record);
  }
}

std::string decompressedPcd(const InputFile& file, const std::string& bytes, std::uint64_t size)
{
  constexpr PlyType sizeType{ 4, PlyType::Kind::Unsigned };
  constexpr std::size_t sizes = 8;
  if (bytes.size() < sizes)
  {
    throw file.error("damaged: it ends before its last point");
  }
  const auto packed = std::uint64_t(sizeType.numberAt(bytes.data(), false));
  if (std::uint64_t(sizeType.numberAt(bytes.data() + 4, false)) != size)
  {
    throw file.error("damaged: its compressed data is not as large as its points");
  }
  if (packed > bytes.size() - sizes)
  {
    throw file.error("damaged: it ends before its last point");
  }
  return decompressLzf(
    std::string_view(bytes).substr(sizes, std::size_t(packed)), std::size_t(size));
}

void readPcdBinary(InputFile& file, const PcdHeader& header, PcdPoints& points)
{
  const std::uint64_t size = behind(0, header.points, header.stride);
  if (header.encoding == "binary")
  {
    const std::string bytes = file.rest();
    if (bytes.size() < size)
    {
      throw file.error("damaged: it ends before its last point");
    }
    readPcdRecords(
      bytes, header, points, [](const PcdField& field) { return field.offset; },
      [&](const PcdField&) { return header.stride; });
    return;
  }
  // Field by field.
  const std::string bytes = decompressedPcd(file, file.rest(), size);
  readPcdRecords(
    bytes, header, points, [&](const PcdField& field) { return header.points * field.offset; },
    [](const PcdField& field) { return field.count * field.type.size; });
}
}

FileContents readPcd(const std::string& path)
{
  InputFile file(path);
  const PcdHeader header = readPcdHeader(file);
  FileContents contents;
  PcdPoints points(header, contents);
  if (header.encoding == "ascii")
  {
    readPcdText(file, header, points);
  }
  else if (header.encoding == "binary" || header.encoding == "binary_compressed")
  {
    readPcdBinary(file, header, points);
  }
  else
  {
    throw file.error("its points are neither ascii, binary nor binary_compressed");
  }
  setViewpoint(header, contents);
  return contents;
}
}
