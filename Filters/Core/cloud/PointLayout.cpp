// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointLayout.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace neuralmesh
{
namespace
{
using Words = std::vector<std::string_view>;

Words wordsOf(std::string_view line)
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

std::uint64_t numberOf(std::string_view text)
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

/// The sum of `offset` and `count` times `size`.
std::uint64_t behind(std::uint64_t offset, std::uint64_t count, std::uint64_t size)
{
  std::uint64_t bytes = 0, sum = 0;
  if (__builtin_mul_overflow(count, size, &bytes) || __builtin_add_overflow(offset, bytes, &sum))
  {
    throw std::runtime_error("damaged: it claims more bytes than any file has");
  }
  return sum;
}

// --- PLY -----------------------------------------------------------------------------------------

std::uint64_t plySize(std::string_view type)
{
  static const std::map<std::string_view, std::uint64_t> sizes{ { "char", 1 }, { "uchar", 1 },
    { "int8", 1 }, { "uint8", 1 }, { "short", 2 }, { "ushort", 2 }, { "int16", 2 }, { "uint16", 2 },
    { "int", 4 }, { "uint", 4 }, { "int32", 4 }, { "uint32", 4 }, { "float", 4 }, { "float32", 4 },
    { "double", 8 }, { "float64", 8 } };
  const auto size = sizes.find(type);
  if (size == sizes.end())
  {
    throw std::runtime_error("damaged: there is no type " + std::string(type));
  }
  return size->second;
}

struct PlyElement
{
  struct Property
  {
    std::string_view type;
    std::uint64_t place;
  };

  std::string_view name;
  std::uint64_t count = 0;
  std::uint64_t size = 0; ///< of a record
  bool hasList = false;
  std::map<std::string_view, Property> properties;
};

void addProperty(PlyElement& element, const Words& words)
{
  if (words.size() > 1 && words[1] == "list")
  {
    element.hasList = true;
    return;
  }
  if (words.size() != 3)
  {
    throw std::runtime_error("damaged: a property has no type or no name");
  }
  element.properties[words[2]] = { words[1], element.size };
  element.size += plySize(words[1]);
}

/// Up to and with that of the vertices. Reads the format, too.
std::vector<PlyElement> plyElements(std::string_view header, PointLayout& layout)
{
  std::vector<PlyElement> elements;
  bool hasFormat = false;
  while (!header.empty())
  {
    const std::size_t end = std::min(header.find('\n'), header.size());
    const Words words = wordsOf(header.substr(0, end));
    header.remove_prefix(std::min(end + 1, header.size()));
    if (words.empty())
    {
      continue;
    }
    if (words[0] == "format" && words.size() > 1)
    {
      if (words[1] != "binary_little_endian" && words[1] != "binary_big_endian")
      {
        throw std::runtime_error("its points are text; only binary ones can be sampled in place");
      }
      hasFormat = true;
      layout.isBigEndian = words[1] == "binary_big_endian";
    }
    else if (words[0] == "element" && words.size() == 3)
    {
      elements.push_back({ words[1], numberOf(words[2]), 0, false, {} });
    }
    else if (words[0] == "property" && !elements.empty())
    {
      addProperty(elements.back(), words);
    }
  }
  if (!hasFormat)
  {
    throw std::runtime_error("damaged: the header names no format");
  }
  return elements;
}

PointLayout layoutOfVertices(const PlyElement& vertices, PointLayout layout)
{
  if (vertices.hasList)
  {
    throw std::runtime_error("its vertices have lists: such cannot be sampled in place");
  }
  layout.stride = vertices.size;
  layout.count = vertices.count;
  const std::array<std::string_view, 3> names{ "x", "y", "z" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto property = vertices.properties.find(names[axis]);
    if (property == vertices.properties.end())
    {
      throw std::runtime_error("its vertices have no " + std::string(names[axis]));
    }
    const auto& [type, place] = property->second;
    const bool isDouble = plySize(type) == 8;
    const bool isReal = isDouble || type == "float" || type == "float32";
    if (!isReal || (axis > 0 && isDouble != layout.isDouble))
    {
      throw std::runtime_error("its coordinates are not all floats, nor all doubles");
    }
    layout.isDouble = isDouble;
    layout.coordinates[axis] = place;
  }
  const auto red = vertices.properties.find("red");
  const auto isByteAt = [&](std::string_view name, std::uint64_t place)
  {
    const auto property = vertices.properties.find(name);
    return property != vertices.properties.end() && property->second.place == place &&
      (property->second.type == "uchar" || property->second.type == "uint8");
  };
  if (red != vertices.properties.end() && isByteAt("red", red->second.place) &&
    isByteAt("green", red->second.place + 1) && isByteAt("blue", red->second.place + 2))
  {
    layout.color = red->second.place;
  }
  return layout;
}

// --- VTP -----------------------------------------------------------------------------------------

/// A tag of XML: its name, with the slash of a closing one, and its attributes.
struct Tag
{
  std::string_view name;
  std::map<std::string_view, std::string_view> attributes;

  std::string_view operator[](std::string_view attribute) const
  {
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? std::string_view() : found->second;
  }
};

/// The tags of a text one by one; what stands between them is left out.
class TagReader
{
public:
  explicit TagReader(std::string_view text)
    : text_(text)
  {
  }

  std::optional<Tag> next()
  {
    place_ = text_.find('<', place_);
    if (place_ == std::string_view::npos)
    {
      return std::nullopt;
    }
    const std::size_t begin = place_ + 1;
    place_ = std::min(text_.find_first_of(" \t\r\n/>", begin + 1), text_.size());
    Tag tag{ text_.substr(begin, place_ - begin), {} };
    while (readAttribute(tag))
    {
    }
    return tag;
  }

  /// Behind the last tag.
  std::size_t place() const { return place_; }

private:
  /// False at the end of the tag.
  bool readAttribute(Tag& tag)
  {
    const std::size_t begin = text_.find_first_not_of(" \t\r\n/?", place_);
    if (begin == std::string_view::npos || text_[begin] == '>')
    {
      place_ = std::min(begin, text_.size() - 1) + 1;
      return false;
    }
    const std::size_t equals = text_.find_first_of("=>", begin);
    const std::size_t open =
      equals == std::string_view::npos ? equals : text_.find_first_of("\"'>", equals);
    const std::size_t close =
      open == std::string_view::npos ? open : text_.find(text_[open], open + 1);
    if (close == std::string_view::npos || text_[equals] != '=' || text_[open] == '>')
    {
      throw std::runtime_error("damaged: its header is no XML");
    }
    tag.attributes[text_.substr(begin, equals - begin)] = text_.substr(open + 1, close - open - 1);
    place_ = close + 1;
    return true;
  }

  std::string_view text_;
  std::size_t place_ = 0;
};

void readFileTag(const Tag& tag, PointLayout& layout)
{
  if (tag["type"] != "PolyData")
  {
    throw std::runtime_error("it holds no PolyData");
  }
  if (!tag["compressor"].empty())
  {
    throw std::runtime_error("it is compressed: such cannot be sampled in place");
  }
  layout.isBigEndian = tag["byte_order"] == "BigEndian";
  layout.sizeField = tag["header_type"] == "UInt64" ? 8 : 4;
}

void readArrayTag(const Tag& tag, PointLayout& layout)
{
  if (tag["format"] != "appended")
  {
    throw std::runtime_error("its points are not appended: such cannot be sampled in place");
  }
  if (tag["NumberOfComponents"] != "3" || (tag["type"] != "Float32" && tag["type"] != "Float64"))
  {
    throw std::runtime_error("its points are not three floats or doubles");
  }
  layout.isDouble = tag["type"] == "Float64";
  layout.offset = numberOf(tag["offset"]);
}
}

PointLayout layoutOfPly(std::string_view beginning)
{
  constexpr std::string_view lastLine = "\nend_header";
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
  PointLayout layout;
  layout.offset = begin + 1;
  for (const PlyElement& element : plyElements(beginning.substr(0, end), layout))
  {
    if (element.name == "vertex")
    {
      return layoutOfVertices(element, layout);
    }
    if (element.hasList && element.count > 0)
    {
      throw std::runtime_error("lists stand before its vertices: such cannot be sampled in place");
    }
    layout.offset = behind(layout.offset, element.count, element.size);
  }
  throw std::runtime_error("there are no vertices in it");
}

PointLayout layoutOfVtp(std::string_view beginning)
{
  PointLayout layout;
  TagReader reader(beginning);
  bool isPoints = false, hasFile = false, hasPoints = false;
  while (const std::optional<Tag> tag = reader.next())
  {
    if (tag->name == "VTKFile")
    {
      hasFile = true;
      readFileTag(*tag, layout);
    }
    else if (tag->name == "Piece")
    {
      if (hasPoints)
      {
        throw std::runtime_error("its points are in several pieces");
      }
      layout.count = numberOf((*tag)["NumberOfPoints"]);
    }
    else if (tag->name == "Points" || tag->name == "/Points")
    {
      isPoints = tag->name == "Points";
    }
    else if (tag->name == "DataArray" && isPoints)
    {
      hasPoints = true;
      readArrayTag(*tag, layout);
    }
    else if (tag->name == "AppendedData")
    {
      if ((*tag)["encoding"] != "raw")
      {
        throw std::runtime_error("its appended data is encoded: such cannot be sampled in place");
      }
      const std::size_t data = beginning.find('_', reader.place());
      if (!hasFile || !hasPoints || data == std::string_view::npos)
      {
        throw std::runtime_error("damaged: there are no points in it");
      }
      layout.stride = 3 * layout.coordinateSize();
      layout.coordinates = { 0, layout.coordinateSize(), 2 * layout.coordinateSize() };
      layout.offset = behind(behind(data + 1, 1, layout.sizeField), 1, layout.offset);
      return layout;
    }
  }
  throw std::runtime_error("there is no raw appended data in it");
}

PointLayout layoutOfRaw(std::uint64_t size, bool isDouble, std::uint64_t skip)
{
  PointLayout layout;
  layout.isDouble = isDouble;
  layout.offset = skip;
  layout.stride = 3 * layout.coordinateSize();
  layout.coordinates = { 0, layout.coordinateSize(), 2 * layout.coordinateSize() };
  if (skip > size || (size - skip) % layout.stride != 0)
  {
    throw std::runtime_error("behind " + std::to_string(skip) +
      " bytes there is no whole number of "
      "points of " +
      std::to_string(layout.stride) + " bytes");
  }
  layout.count = (size - skip) / layout.stride;
  return layout;
}
}
