// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace neuralmesh
{
/// The next word of a line, which is taken off it; empty at its end. Words are apart by blanks,
/// tabulators, commas or semicolons.
std::string_view takeWord(std::string_view& line);

/// Whether a word is a number, be it nan or inf, and nothing else.
bool parseNumber(std::string_view word, double& number);

/// Whether a word is a whole number, without a sign.
bool parseCount(std::string_view word, std::uint64_t& number);

/// Takes so many numbers off a line, to `numbers`; false if there are fewer.
bool takeNumbers(std::string_view& line, std::size_t count, double* numbers);

/// The shortest text that reads as the number.
std::string textOf(double number);
std::string textOf(float number);
/// The whole part of a number, without an exponent.
std::string wholeTextOf(double number);
}
