// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace neuralmesh::testing
{
inline constexpr unsigned SideOfSheets = 24;

/// Two sheets above each other, of SideOfSheets quadrangles along a side, that are joined around each of the given
/// quadrangles by a tube of four edges.
inline TriangleMesh joinedSheets(const std::vector<std::pair<unsigned, unsigned>>& joints)
{
  TriangleMesh sheets;
  const auto at = [](unsigned sheet, unsigned i, unsigned j)
  { return std::uint32_t((sheet * (SideOfSheets + 1) + i) * (SideOfSheets + 1) + j); };
  for (unsigned sheet = 0; sheet < 2; ++sheet)
  {
    for (unsigned i = 0; i <= SideOfSheets; ++i)
    {
      for (unsigned j = 0; j <= SideOfSheets; ++j)
      {
        sheets.points.emplace_back(i, j, sheet);
      }
    }
  }
  const auto addQuadrangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d)
  {
    sheets.triangles.push_back({ a, b, c });
    sheets.triangles.push_back({ a, c, d });
  };
  for (unsigned i = 0; i < SideOfSheets; ++i)
  {
    for (unsigned j = 0; j < SideOfSheets; ++j)
    {
      const auto corner = [&](unsigned sheet, unsigned k)
      { return at(sheet, i + (k == 1 || k == 2 ? 1 : 0), j + (k >= 2 ? 1 : 0)); };
      if (std::find(joints.begin(), joints.end(), std::pair(i, j)) == joints.end())
      {
        addQuadrangle(corner(1, 0), corner(1, 1), corner(1, 2), corner(1, 3));
        addQuadrangle(corner(0, 3), corner(0, 2), corner(0, 1), corner(0, 0));
        continue;
      }
      for (unsigned k = 0; k < 4; ++k)
      {
        const unsigned next = (k + 1) % 4;
        addQuadrangle(corner(1, k), corner(1, next), corner(0, next), corner(0, k));
      }
    }
  }
  return sheets;
}
}
