// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud/PlyHeader.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace neuralmesh
{
/// How points lie in a file: in records of the same size, one behind the other. Sizes and places in
/// bytes.
struct PointLayout
{
  std::uint64_t offset = 0; ///< of the first record in the file
  std::uint64_t stride = 0; ///< of a record
  std::uint64_t count = 0;
  std::array<std::uint64_t, 3> coordinates{}; ///< places of x, y and z in the record
  bool isDouble = false;                      ///< whether they are of 8 bytes, or 4
  bool isBigEndian = false;
  std::optional<std::uint64_t> color; ///< place of red, green and blue, of a byte each
  /// Places of nx, ny and nz, which are as the coordinates are.
  std::optional<std::array<std::uint64_t, 3>> normal;
  /// Just before the first record there is a number of so many bytes, which tells how many bytes the
  /// records have; 0: there is none.
  std::uint64_t sizeField = 0;

  std::uint64_t coordinateSize() const { return isDouble ? 8 : 4; }
};

/// What the header of a .ply says, given the beginning of the file, up to LongestHeader bytes of it.
/// The points must be binary, of either byte order. Throws std::runtime_error, without the name of
/// the file, if they do not lie as records, or the header is damaged.
PointLayout layoutOfPly(std::string_view beginning);
/// Of a .vtp, whose points must be appended raw, without compression, in one piece.
PointLayout layoutOfVtp(std::string_view beginning);
/// Of `size` bytes that are x y z, behind `skip` bytes of something else.
PointLayout layoutOfRaw(std::uint64_t size, bool isDouble, std::uint64_t skip);
}
