// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace neuralmesh
{
/// What commas are in a line of numbers.
enum class CommaUse
{
  Separates,
  IsDecimal, ///< as in 1,25 2,5 3,75
  IsUnclear  ///< thousands, or both: nothing tells
};

/// Tells it by the first `count` words that blanks, tabulators or semicolons set apart. Commas are
/// decimal where each of these words has one at most, between digits, and no point.
CommaUse commaUse(std::string_view line, std::size_t count);

/// Whether numbers that commas alone set apart have zeros in front, as digits behind a decimal comma
/// have: 1,05,2,5.
bool hasTornNumbers(std::string_view line);

/// The fields of a line of text, without what begins with # or // in it, and without quotes. They
/// lie in the line, which must outlive them.
class TextRow
{
public:
  /// The fields between semicolons, tabulators or commas, of which some may be empty, and some have
  /// the separator in quotes; where there is none of `separator`, or it is a blank, as below.
  void splitAt(std::string_view line, char separator, bool areCommasDecimal = false);
  /// Words apart by blanks, tabulators, semicolons, or commas that are not decimal.
  void splitWords(std::string_view line, bool areCommasDecimal);

  /// With empty fields at the end.
  std::size_t size() const { return fields_.size(); }
  /// Without them.
  std::size_t filledSize() const;
  /// Empty beyond the end.
  std::string_view operator[](std::size_t i) const;
  /// Whether a field is a number; its comma is decimal, if it has a single one.
  bool number(std::size_t i, double& value) const;

private:
  std::vector<std::string_view> fields_;
};
}
