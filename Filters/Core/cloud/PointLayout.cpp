// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/PointLayout.h"

#include "cloud/PlyHeader.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

namespace neuralmesh
{
namespace
{
/// Those of nx, ny and nz, if all are there and of the type of the coordinates.
std::optional<std::array<std::uint64_t, 3>> normalPlaces(const PlyElement& vertices, bool isDouble)
{
  std::array<std::uint64_t, 3> places{};
  const std::array<std::string_view, 3> names{ "nx", "ny", "nz" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const PlyProperty* property = vertices.find(names[axis]);
    if (!property || !property->type.isReal() || (property->type.size == 8) != isDouble)
    {
      return std::nullopt;
    }
    places[axis] = vertices.placeOf(*property);
  }
  return places;
}

PointLayout layoutOfVertices(const PlyElement& vertices, PointLayout layout)
{
  if (vertices.hasList())
  {
    throw std::runtime_error("its vertices have lists: such cannot be sampled in place");
  }
  layout.stride = vertices.size();
  layout.count = vertices.count;
  const std::array<const char*, 3> names{ "x", "y", "z" };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const PlyProperty* property = vertices.find(names[axis]);
    if (!property)
    {
      throw std::runtime_error("its vertices have no " + std::string(names[axis]));
    }
    const bool isDouble = property->type.size == 8;
    if (!property->type.isReal() || (axis > 0 && isDouble != layout.isDouble))
    {
      throw std::runtime_error("its coordinates are not all floats, nor all doubles");
    }
    layout.isDouble = isDouble;
    layout.coordinates[axis] = vertices.placeOf(*property);
  }
  const PlyProperty* red = vertices.find("red");
  const auto isByteBehindRed = [&](std::string_view name, std::uint64_t bytes)
  {
    const PlyProperty* property = vertices.find(name);
    return red && property && property->type.size == 1 &&
      property->type.kind == PlyType::Kind::Unsigned &&
      vertices.placeOf(*property) == vertices.placeOf(*red) + bytes;
  };
  if (isByteBehindRed("red", 0) && isByteBehindRed("green", 1) && isByteBehindRed("blue", 2))
  {
    layout.color = vertices.placeOf(*red);
  }
  layout.normal = normalPlaces(vertices, layout.isDouble);
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
  layout.offset = countOf(tag["offset"]);
}
}

PointLayout layoutOfPly(std::string_view beginning)
{
  const PlyHeader header = readPlyHeader(beginning);
  if (header.isText)
  {
    throw std::runtime_error(
      "its points are text; only binary ones can be sampled in place: read the "
      "file as a whole");
  }
  PointLayout layout;
  layout.isBigEndian = header.isBigEndian;
  layout.offset = header.size;
  for (const PlyElement& element : header.elements)
  {
    if (element.name == "vertex")
    {
      return layoutOfVertices(element, layout);
    }
    if (element.hasList() && element.count > 0)
    {
      throw std::runtime_error("lists stand before its vertices: such cannot be sampled in place");
    }
    layout.offset = behind(layout.offset, element.count, element.size());
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
      layout.count = countOf((*tag)["NumberOfPoints"]);
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
