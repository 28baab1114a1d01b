// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlyContents.h"

#include "cloud/PlyHeader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
constexpr std::string_view ShiftWord = "shift";
constexpr std::array<const char*, 3> Axes{ "x", "y", "z" };
constexpr std::uint64_t BytesPerPiece = 1 << 20;

[[noreturn]] void throwEndsEarly(const PlyElement& element)
{
  throw std::runtime_error("damaged: it ends before its last " + element.name);
}

[[noreturn]] void throwUnreadable() { throw std::runtime_error("it cannot be read to its end"); }

double numberOf(std::string_view word)
{
  word.remove_prefix(word.starts_with('+') ? 1 : 0);
  double number = 0.;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (end != word.data() + word.size() ||
    (error != std::errc() && error != std::errc::result_out_of_range))
  {
    throw std::runtime_error("damaged: '" + std::string(word.substr(0, 40)) + "' is no coordinate");
  }
  return number;
}

/// Which coordinate each property of the vertices is, if it is one that is wanted.
using AxisOfProperty = std::vector<std::optional<Eigen::Index>>;

/// The elements of a text: a line for each.
class TextElements
{
public:
  explicit TextElements(std::ifstream& file)
    : file_(file)
  {
  }

  /// Calls `take` with the values of each record that are coordinates.
  template <typename Take>
  void read(const PlyElement& element, const AxisOfProperty& axes, const Take& take)
  {
    std::string line;
    for (std::uint64_t i = 0; i < element.count && !axes.empty(); ++i)
    {
      if (!std::getline(file_, line))
      {
        throwEndsEarly(element);
      }
      const auto words = wordsOf(line);
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      std::size_t next = 0;
      for (std::size_t p = 0; p < axes.size(); ++p)
      {
        const std::size_t word = next++;
        if (element.properties[p].countType && word < words.size())
        {
          next += std::size_t(std::min<std::uint64_t>(countOf(words[word]), words.size()));
        }
        if (next > words.size())
        {
          throwTooShort(element, i);
        }
        if (axes[p])
        {
          point[*axes[p]] = numberOf(words[word]);
        }
      }
      take(point);
    }
  }

private:
  [[noreturn]] void throwTooShort(const PlyElement& element, std::uint64_t number)
  {
    if (file_.peek() == std::ifstream::traits_type::eof())
    {
      throwEndsEarly(element);
    }
    throw std::runtime_error(
      "damaged: the line of " + element.name + " " + std::to_string(number) + " is too short");
  }

  std::ifstream& file_;
};

/// The elements of a binary file, of which so many bytes are left.
class BinaryElements
{
public:
  BinaryElements(std::ifstream& file, std::uint64_t left, bool isBigEndian)
    : file_(file)
    , left_(left)
    , isBigEndian_(isBigEndian)
  {
  }

  /// As that of TextElements.
  template <typename Take>
  void read(const PlyElement& element, const AxisOfProperty& axes, const Take& take)
  {
    for (std::uint64_t i = 0; i < element.count && !axes.empty(); ++i)
    {
      Eigen::Vector3d point = Eigen::Vector3d::Zero();
      for (std::size_t p = 0; p < axes.size(); ++p)
      {
        const PlyProperty& property = element.properties[p];
        const PlyType first = property.countType.value_or(property.type);
        const double number = first.numberAt(next(element, first.size), isBigEndian_);
        if (property.countType)
        {
          skip(element, number < 0. ? left_ + 1 : std::uint64_t(number), property.type.size);
        }
        else if (axes[p])
        {
          point[*axes[p]] = number;
        }
      }
      take(point);
    }
  }

  void skip(const PlyElement& element, std::uint64_t count, std::uint64_t size)
  {
    const std::uint64_t bytes = behind(0, count, size);
    if (bytes > left_)
    {
      throwEndsEarly(element);
    }
    left_ -= bytes;
    const std::uint64_t known = std::min<std::uint64_t>(bytes, piece_.size() - place_);
    place_ += std::size_t(known);
    if (bytes > known)
    {
      file_.seekg(std::streamoff(bytes - known), std::ios::cur);
    }
  }

  /// All of an element that is the first to be read.
  void readFirst(const PlyElement& element, std::vector<float>& numbers)
  {
    const std::uint64_t bytes = behind(0, element.count, element.size());
    if (bytes > left_)
    {
      throwEndsEarly(element);
    }
    left_ -= bytes;
    numbers.resize(std::size_t(bytes) / sizeof(float));
    file_.read(reinterpret_cast<char*>(numbers.data()), std::streamsize(bytes));
    if (!file_)
    {
      throwUnreadable();
    }
  }

private:
  const unsigned char* next(const PlyElement& element, std::uint64_t size)
  {
    if (size > left_)
    {
      throwEndsEarly(element);
    }
    if (size > piece_.size() - place_)
    {
      piece_.erase(piece_.begin(), piece_.begin() + std::ptrdiff_t(place_));
      place_ = 0;
      const std::size_t kept = piece_.size();
      piece_.resize(std::size_t(std::min(left_, BytesPerPiece)));
      file_.read(
        reinterpret_cast<char*>(piece_.data() + kept), std::streamsize(piece_.size() - kept));
      if (!file_)
      {
        throwUnreadable();
      }
    }
    const unsigned char* bytes = piece_.data() + place_;
    place_ += std::size_t(size);
    left_ -= size;
    return bytes;
  }

  std::ifstream& file_;
  std::uint64_t left_;
  bool isBigEndian_;
  std::vector<unsigned char> piece_;
  std::size_t place_ = 0;
};

/// Tells which properties are x, y and z; returns false, and leaves them out, if floats hold them all.
bool markCoordinates(const PlyElement& vertices, AxisOfProperty& axes)
{
  AxisOfProperty marked(axes.size());
  bool isWanted = false;
  for (std::size_t axis = 0; axis < Axes.size(); ++axis)
  {
    const PlyProperty* property = vertices.find(Axes[axis]);
    if (!property || property->countType)
    {
      throw std::runtime_error("its vertices have no " + std::string(Axes[axis]));
    }
    isWanted = isWanted || !property->type.fitsFloat();
    marked[std::size_t(property - vertices.properties.data())] = Eigen::Index(axis);
  }
  if (isWanted)
  {
    axes = marked;
  }
  return isWanted;
}

/// Whether the bytes of the file are x, y, z of the vertices, as floats of this machine, and nothing else.
bool hasOnlyFloats(const PlyHeader& header)
{
  if (header.isText || header.isBigEndian || std::endian::native != std::endian::little ||
    header.elements.size() != 1 || header.elements[0].name != "vertex" ||
    header.elements[0].properties.size() != Axes.size())
  {
    return false;
  }
  return std::equal(Axes.begin(), Axes.end(), header.elements[0].properties.begin(),
    [](const char* axis, const PlyProperty& property)
    {
      return property.name == axis && !property.countType && property.type.isReal() &&
        property.type.size == sizeof(float);
    });
}
}

PlyContents readPlyContents(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    throw std::runtime_error("it cannot be opened for reading");
  }
  std::string beginning(LongestHeader, '\0');
  file.read(beginning.data(), std::streamsize(beginning.size()));
  beginning.resize(std::size_t(file.gcount()));
  const PlyHeader header = readPlyHeader(beginning);
  file.clear();
  file.seekg(0, std::ios::end);
  const std::uint64_t size = std::uint64_t(file.tellg());
  file.seekg(std::streamoff(header.size));

  PlyContents contents;
  for (const std::string& comment : header.comments)
  {
    contents.shift = contents.shift ? contents.shift : shiftOfComment(comment);
  }
  TextElements text(file);
  BinaryElements binary(file, size - header.size, header.isBigEndian);
  if (hasOnlyFloats(header))
  {
    binary.readFirst(header.elements[0], contents.floats);
    return contents;
  }
  bool hasVertices = false;
  for (const PlyElement& element : header.elements)
  {
    AxisOfProperty axes(element.properties.size());
    bool isWanted = false;
    if (element.name == "vertex" && !hasVertices)
    {
      hasVertices = true;
      isWanted = markCoordinates(element, axes);
      // Each takes bytes in the file, whatever the header says.
      contents.coordinates.reserve(isWanted ? 3 * std::size_t(std::min(element.count, size)) : 0);
    }
    const auto take = [&](const Eigen::Vector3d& point)
    {
      if (isWanted)
      {
        contents.coordinates.insert(contents.coordinates.end(), point.begin(), point.end());
      }
    };
    if (header.isText)
    {
      text.read(element, axes, take);
    }
    else if (isWanted || element.hasList())
    {
      binary.read(element, axes, take);
    }
    else
    {
      binary.skip(element, element.count, element.size());
    }
  }
  if (!hasVertices)
  {
    throw std::runtime_error("there are no vertices in it");
  }
  return contents;
}

std::optional<Eigen::Vector3d> shiftOfComment(std::string_view comment)
{
  const auto words = wordsOf(comment);
  if (words.size() != 4 || words[0] != ShiftWord)
  {
    return std::nullopt;
  }
  Eigen::Vector3d shift;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string_view word = words[axis + 1];
    double& number = shift[Eigen::Index(axis)];
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
    {
      return std::nullopt;
    }
  }
  return shift;
}

std::string commentOfShift(const Eigen::Vector3d& shift)
{
  std::string comment(ShiftWord);
  for (const double number : shift)
  {
    // As plain as 500000, where the default may be 5e+05.
    std::array<char, 400> digits{};
    const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::fixed);
    comment.append(" ").append(digits.data(), end.ptr);
  }
  return comment;
}

std::string withDoubles(const std::string& ply, std::span<const double> coordinates)
{
  constexpr std::size_t floats = 3 * sizeof(float), doubles = 3 * sizeof(double);
  const PlyHeader header = readPlyHeader(ply);
  const std::size_t stride = std::size_t(header.elements.front().size());
  std::string result = ply.substr(0, std::size_t(header.size));
  for (const char* axis : Axes)
  {
    const std::string line = std::string(" ") + axis + "\n";
    const std::string found = "property float" + line;
    result.replace(result.find(found), found.size(), "property double" + line);
  }
  result.reserve(ply.size() + coordinates.size_bytes());
  std::size_t place = std::size_t(header.size);
  for (std::size_t i = 0; i < coordinates.size(); i += 3, place += stride)
  {
    std::array<char, doubles> bytes{};
    std::memcpy(bytes.data(), &coordinates[i], doubles);
    result.append(bytes.data(), doubles);
    result.append(ply, place + floats, stride - floats);
  }
  return result.append(ply, place, std::string::npos);
}
}
