// SPDX-License-Identifier: BSD-3-Clause
#include "file/TextColumns.h"

#include "file/TextRow.h"

#include <cctype>
#include <string>
#include <vector>

namespace neuralmesh
{
namespace
{
using Triple = std::array<const char*, 3>;

constexpr std::array<Triple, 3> PositionNames{ { { "x", "y", "z" },
  { "points:0", "points:1", "points:2" }, { "points_0", "points_1", "points_2" } } };
constexpr std::array<Triple, 5> NormalNames{ { { "nx", "ny", "nz" },
  { "normal_x", "normal_y", "normal_z" }, { "normalx", "normaly", "normalz" },
  { "normals:0", "normals:1", "normals:2" }, { "normals_0", "normals_1", "normals_2" } } };

/// In small letters, without a unit in brackets.
std::string plainName(std::string_view name)
{
  name = name.substr(0, name.find_first_of("[("));
  while (!name.empty() && name.back() == ' ')
  {
    name.remove_suffix(1);
  }
  std::string plain;
  for (const char letter : name)
  {
    plain += char(std::tolower(static_cast<unsigned char>(letter)));
  }
  return plain;
}

template <std::size_t Size>
std::optional<std::array<std::size_t, 3>> placesOf(
  const std::array<Triple, Size>& names, const std::vector<std::string>& columns)
{
  for (const Triple& triple : names)
  {
    std::array<std::size_t, 3> places{};
    std::size_t found = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      while (places[axis] < columns.size() && columns[places[axis]] != triple[axis])
      {
        ++places[axis];
      }
      found += places[axis] < columns.size() ? 1 : 0;
    }
    if (found == 3)
    {
      return places;
    }
  }
  return std::nullopt;
}
}

std::optional<TextColumns> columnsOfNames(std::string_view line)
{
  TextColumns columns;
  for (const char separator : { ',', '\t', ';' })
  {
    columns.separator =
      line.find(separator) == std::string_view::npos ? columns.separator : separator;
  }
  TextRow row;
  row.splitAt(line, columns.separator);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    names.push_back(plainName(row[i]));
  }
  columns.count = names.size();
  const auto position = placesOf(PositionNames, names);
  if (!position)
  {
    return std::nullopt;
  }
  columns.position = *position;
  columns.normal = placesOf(NormalNames, names);
  return columns;
}
}
