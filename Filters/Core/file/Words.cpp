// SPDX-License-Identifier: BSD-3-Clause
#include "file/Words.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

namespace neuralmesh
{
namespace
{
bool isSeparator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

template <typename Number>
std::string shortestText(Number number)
{
  std::array<char, 64> digits{};
  // Without an exponent where VTK writes none.
  const Number size = std::abs(number);
  const auto format = size == 0 || (size >= Number(1e-6) && size < Number(1e21))
    ? std::chars_format::fixed
    : std::chars_format::scientific;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, format).ptr;
  return { digits.data(), end };
}
}

std::string_view takeWord(std::string_view& line)
{
  std::size_t begin = 0;
  while (begin < line.size() && isSeparator(line[begin]))
  {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !isSeparator(line[end]))
  {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool parseNumber(std::string_view word, double& number)
{
  if (!word.empty() && word.front() == '+')
  {
    word.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

bool parseCount(std::string_view word, std::uint64_t& number)
{
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

bool takeNumbers(std::string_view& line, std::size_t count, double* numbers)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    if (!parseNumber(takeWord(line), numbers[i]))
    {
      return false;
    }
  }
  return true;
}

std::string textOf(double number) { return shortestText(number); }

std::string textOf(float number) { return shortestText(number); }

std::string wholeTextOf(double number)
{
  constexpr std::size_t MostDigits = std::numeric_limits<double>::max_exponent10 + 1;
  std::array<char, MostDigits + 1> text{};
  const auto end =
    std::to_chars(text.begin(), text.end(), std::trunc(number), std::chars_format::fixed, 0);
  return { text.begin(), end.ptr };
}
}
