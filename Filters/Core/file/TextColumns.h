// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace neuralmesh
{
/// Which columns of a text have what.
struct TextColumns
{
  std::array<std::size_t, 3> position{ 0, 1, 2 };
  std::optional<std::array<std::size_t, 3>> normal;
  std::size_t count = 0; ///< of names; 0: there are none
  char separator = ' ';  ///< between the names
};

/// By a line of names of columns: x, y and z, or Points:0, Points:1 and Points:2, as ParaView has them;
/// normals are nx, normal_x or Normals:0 and so on. Small letters or capitals, in quotes or not, with a
/// unit in brackets or without; apart by semicolons, tabulators, commas or blanks, the first of these
/// that are there. Of two columns of a name, it is the first. Nullopt where x, y or z is missing.
std::optional<TextColumns> columnsOfNames(std::string_view line);
}
