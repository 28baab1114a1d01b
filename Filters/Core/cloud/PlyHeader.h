// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// A number in a binary file, as a .ply names it.
struct PlyType
{
  enum class Kind
  {
    Signed,
    Unsigned,
    Real
  };

  std::uint64_t size = 0; ///< in bytes, where the file is binary
  Kind kind = Kind::Signed;

  bool isReal() const { return kind == Kind::Real; }
  /// Whether a float holds each of its values.
  bool fitsFloat() const { return size < (isReal() ? 8 : 4); }
  /// The number whose bytes lie there.
  double numberAt(const void* place, bool isBigEndian) const;
};

struct PlyProperty
{
  std::string name;
  PlyType type;                     ///< of what stands in the list, if it is one
  std::optional<PlyType> countType; ///< of a list: its length, which stands before it
};

struct PlyElement
{
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  bool hasList() const;
  /// Bytes of a record without its lists.
  std::uint64_t size() const;
  /// The first property of the name, or null.
  const PlyProperty* find(std::string_view property) const;
  /// Bytes of a record before a property of it, without lists.
  std::uint64_t placeOf(const PlyProperty& property) const;
};

/// What the header of a .ply says.
struct PlyHeader
{
  bool isText = false;
  bool isBigEndian = false;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments; ///< without the word `comment`
  std::uint64_t size = 0;            ///< bytes up to the first record
};

/// Bytes of a file in which its header must end.
constexpr std::size_t LongestHeader = std::size_t(1) << 20;

/// Reads the header, given the beginning of the file, up to LongestHeader bytes of it. Throws
/// std::runtime_error, without the name of the file, if it is none or damaged.
PlyHeader readPlyHeader(std::string_view beginning);

/// The words of a line, between blanks and tabulators.
std::vector<std::string_view> wordsOf(std::string_view line);

/// A number of bytes or points, as a header has it; throws std::runtime_error if it is none.
std::uint64_t countOf(std::string_view text);

/// The sum of `offset` and `count` times `size`; throws std::runtime_error if no file is so long.
std::uint64_t behind(std::uint64_t offset, std::uint64_t count, std::uint64_t size);
}
