// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PlyHeader.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <map>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
static_assert(std::endian::native == std::endian::little);

using Words = std::vector<std::string_view>;

template <typename Number>
double numberIn(std::array<unsigned char, 8> bytes)
{
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof number);
  return double(number);
}

PlyType plyType(std::string_view name)
{
  using enum PlyType::Kind;
  static const std::map<std::string_view, PlyType> types{ { "char", { 1, Signed } },
    { "int8", { 1, Signed } }, { "uchar", { 1, Unsigned } }, { "uint8", { 1, Unsigned } },
    { "short", { 2, Signed } }, { "int16", { 2, Signed } }, { "ushort", { 2, Unsigned } },
    { "uint16", { 2, Unsigned } }, { "int", { 4, Signed } }, { "int32", { 4, Signed } },
    { "uint", { 4, Unsigned } }, { "uint32", { 4, Unsigned } }, { "float", { 4, Real } },
    { "float32", { 4, Real } }, { "double", { 8, Real } }, { "float64", { 8, Real } } };
  const auto type = types.find(name);
  if (type == types.end())
  {
    throw std::runtime_error("damaged: there is no type " + std::string(name));
  }
  return type->second;
}

PlyProperty propertyOf(const Words& words)
{
  const bool isList = words.size() > 1 && words[1] == "list";
  if (words.size() != (isList ? 5 : 3))
  {
    throw std::runtime_error("damaged: a property has no type or no name");
  }
  PlyProperty property{ std::string(words.back()), plyType(words[words.size() - 2]), {} };
  if (isList)
  {
    property.countType = plyType(words[2]);
    if (property.countType->isReal())
    {
      throw std::runtime_error("damaged: the length of a list is no whole number");
    }
  }
  return property;
}

void readFormat(std::string_view format, PlyHeader& header)
{
  header.isText = format == "ascii";
  header.isBigEndian = format == "binary_big_endian";
  if (!header.isText && !header.isBigEndian && format != "binary_little_endian")
  {
    throw std::runtime_error("damaged: there is no format " + std::string(format));
  }
}

/// The lines between the first and the last one.
void readLines(std::string_view lines, PlyHeader& header)
{
  bool hasFormat = false;
  while (!lines.empty())
  {
    const std::string_view line = lines.substr(0, lines.find('\n'));
    lines.remove_prefix(std::min(line.size() + 1, lines.size()));
    const Words words = wordsOf(line);
    if (words.empty())
    {
      continue;
    }
    if (words[0] == "format" && words.size() > 1)
    {
      hasFormat = true;
      readFormat(words[1], header);
    }
    else if (words[0] == "element" && words.size() == 3)
    {
      header.elements.push_back({ std::string(words[1]), countOf(words[2]), {} });
    }
    else if (words[0] == "property" && !header.elements.empty())
    {
      header.elements.back().properties.push_back(propertyOf(words));
    }
    else if (words[0] == "comment" && words.size() > 1)
    {
      header.comments.emplace_back(words[1].data(), words.back().data() + words.back().size());
    }
  }
  if (!hasFormat)
  {
    throw std::runtime_error("damaged: the header names no format");
  }
}
}

double PlyType::numberAt(const void* place, bool isBigEndian) const
{
  std::array<unsigned char, 8> bytes{};
  std::memcpy(bytes.data(), place, size);
  if (isBigEndian)
  {
    std::reverse(bytes.begin(), bytes.begin() + std::ptrdiff_t(size));
  }
  if (isReal())
  {
    return size == 8 ? numberIn<double>(bytes) : numberIn<float>(bytes);
  }
  const bool isSigned = kind == Kind::Signed;
  switch (size)
  {
    case 1:
      return isSigned ? numberIn<std::int8_t>(bytes) : numberIn<std::uint8_t>(bytes);
    case 2:
      return isSigned ? numberIn<std::int16_t>(bytes) : numberIn<std::uint16_t>(bytes);
    case 4:
      return isSigned ? numberIn<std::int32_t>(bytes) : numberIn<std::uint32_t>(bytes);
    default:
      return isSigned ? numberIn<std::int64_t>(bytes) : numberIn<std::uint64_t>(bytes);
  }
}

bool PlyElement::hasList() const
{
  return std::any_of(properties.begin(), properties.end(),
    [](const PlyProperty& property) { return property.countType.has_value(); });
}

std::uint64_t PlyElement::size() const
{
  return properties.empty() ? 0 : placeOf(properties.back()) + properties.back().type.size;
}

const PlyProperty* PlyElement::find(std::string_view property) const
{
  const auto found = std::find_if(properties.begin(), properties.end(),
    [property](const PlyProperty& other) { return other.name == property; });
  return found == properties.end() ? nullptr : &*found;
}

std::uint64_t PlyElement::placeOf(const PlyProperty& property) const
{
  std::uint64_t place = 0;
  for (const PlyProperty* before = properties.data(); before != &property; ++before)
  {
    place += before->type.size;
  }
  return place;
}

PlyHeader readPlyHeader(std::string_view beginning)
{
  constexpr std::string_view lastLine = "\nend_header";
  if (beginning.empty())
  {
    throw std::runtime_error("there is nothing in it");
  }
  if (!beginning.starts_with("ply\n") && !beginning.starts_with("ply\r\n"))
  {
    throw std::runtime_error("this is no .ply with lines as they should be");
  }
  const std::size_t end = beginning.find(lastLine);
  const std::size_t begin =
    end == std::string_view::npos ? end : beginning.find('\n', end + lastLine.size());
  if (begin == std::string_view::npos)
  {
    throw std::runtime_error("damaged: its header does not end");
  }
  PlyHeader header;
  header.size = begin + 1;
  readLines(beginning.substr(0, end), header);
  return header;
}

std::vector<std::string_view> wordsOf(std::string_view line)
{
  constexpr std::string_view blanks = " \t\r";
  Words words;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;)
  {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
  return words;
}

std::uint64_t countOf(std::string_view text)
{
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
  {
    throw std::runtime_error(
      "damaged: '" + std::string(text) + "' is no number of bytes or points");
  }
  return number;
}

std::uint64_t behind(std::uint64_t offset, std::uint64_t count, std::uint64_t size)
{
  std::uint64_t bytes = 0, sum = 0;
  if (__builtin_mul_overflow(count, size, &bytes) || __builtin_add_overflow(offset, bytes, &sum))
  {
    throw std::runtime_error("damaged: it claims more bytes than any file has");
  }
  return sum;
}
}
