// SPDX-License-Identifier: BSD-3-Clause
#include "file/TextRow.h"

#include "file/Words.h"

#include <algorithm>
#include <array>

namespace neuralmesh
{
namespace
{
/// More has no number that is worth reading.
constexpr std::size_t LongestNumber = 64;
constexpr std::string_view Blanks = " \t\r";

bool isDigit(char c) { return c >= '0' && c <= '9'; }

bool isGap(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ';'; }

std::string_view withoutComment(std::string_view line)
{
  bool isQuoted = false, isBegin = true;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    isQuoted = isQuoted != (line[i] == '"');
    if (!isQuoted && isBegin && (line[i] == '#' || line.substr(i).starts_with("//")))
    {
      return line.substr(0, i);
    }
    isBegin = isGap(line[i]) || line[i] == ',';
  }
  return line;
}

std::string_view bare(std::string_view field)
{
  const auto trim = [&field](std::string_view letters)
  {
    field.remove_prefix(std::min(field.find_first_not_of(letters), field.size()));
    field.remove_suffix(field.size() - 1 - field.find_last_not_of(letters));
  };
  trim(Blanks);
  if (field.size() > 1 && field.front() == '"' && field.back() == '"')
  {
    field = field.substr(1, field.size() - 2);
    trim(Blanks);
  }
  return field;
}

/// The next word between gaps, which is taken off the line.
std::string_view takeGroup(std::string_view& line)
{
  const auto* begin = std::find_if_not(line.begin(), line.end(), isGap);
  const auto* end = std::find_if(begin, line.end(), isGap);
  const auto word = line.substr(std::size_t(begin - line.begin()), std::size_t(end - begin));
  line.remove_prefix(std::size_t(end - line.begin()));
  return word;
}

/// Whether a comma has digits before and behind it, at most three and just three.
bool isThousands(std::string_view word, std::size_t comma)
{
  std::size_t before = 0, behind = 0;
  while (before < comma && isDigit(word[comma - 1 - before]))
  {
    ++before;
  }
  while (comma + 1 + behind < word.size() && isDigit(word[comma + 1 + behind]))
  {
    ++behind;
  }
  return before <= 3 && behind == 3;
}
}

CommaUse commaUse(std::string_view line, std::size_t count)
{
  line = withoutComment(line);
  if (line.find(',') == std::string_view::npos)
  {
    return CommaUse::Separates;
  }
  std::size_t words = 0, most = 0;
  bool hasPoint = false, areThousands = true;
  for (; words < count; ++words)
  {
    const std::string_view word = takeGroup(line);
    if (word.empty())
    {
      break;
    }
    std::size_t commas = 0;
    for (std::size_t i = word.find(','); i != std::string_view::npos; i = word.find(',', i + 1))
    {
      if (i == 0 || i + 1 == word.size() || !isDigit(word[i - 1]) || !isDigit(word[i + 1]))
      {
        return CommaUse::Separates;
      }
      areThousands = areThousands && isThousands(word, i);
      ++commas;
    }
    most = std::max(most, commas);
    hasPoint = hasPoint || word.find('.') != std::string_view::npos;
  }
  if (words < 2 || most == 0)
  {
    return CommaUse::Separates;
  }
  if (most > 1)
  {
    return areThousands ? CommaUse::IsUnclear : CommaUse::Separates;
  }
  return hasPoint ? CommaUse::IsUnclear : CommaUse::IsDecimal;
}

bool hasTornNumbers(std::string_view line)
{
  line = withoutComment(line);
  bool isBegin = true, hasZeros = false;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    if (!isDigit(line[i]) && line[i] != ',' && line[i] != '-' && line[i] != '\r')
    {
      return false;
    }
    hasZeros =
      hasZeros || (isBegin && line[i] == '0' && i + 1 < line.size() && isDigit(line[i + 1]));
    isBegin = line[i] == ',' || line[i] == '-';
  }
  return hasZeros;
}

void TextRow::splitAt(std::string_view line, char separator, bool areCommasDecimal)
{
  const std::string_view text = withoutComment(line);
  if (separator == ' ' || text.find(separator) == std::string_view::npos)
  {
    splitWords(text, areCommasDecimal);
    return;
  }
  fields_.clear();
  bool isQuoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i)
  {
    if (i == text.size() || (text[i] == separator && !isQuoted))
    {
      fields_.push_back(bare(text.substr(begin, i - begin)));
      begin = i + 1;
    }
    else if (text[i] == '"')
    {
      isQuoted = !isQuoted;
    }
  }
}

void TextRow::splitWords(std::string_view line, bool areCommasDecimal)
{
  fields_.clear();
  std::string_view rest = withoutComment(line);
  const auto take = [&] { return areCommasDecimal ? takeGroup(rest) : takeWord(rest); };
  for (std::string_view word = take(); !word.empty(); word = take())
  {
    fields_.push_back(bare(word));
  }
}

std::size_t TextRow::filledSize() const
{
  const auto last = std::find_if(
    fields_.rbegin(), fields_.rend(), [](std::string_view field) { return !field.empty(); });
  return std::size_t(fields_.rend() - last);
}

std::string_view TextRow::operator[](std::size_t i) const
{
  return i < fields_.size() ? fields_[i] : std::string_view();
}

bool TextRow::number(std::size_t i, double& value) const
{
  const std::string_view field = (*this)[i];
  const std::size_t comma = field.find(',');
  if (comma == std::string_view::npos)
  {
    return parseNumber(field, value);
  }
  std::array<char, LongestNumber> digits{};
  if (field.size() > digits.size() || field.find_first_of(",.", comma + 1) != field.npos ||
    field.find('.') < comma)
  {
    return false;
  }
  std::copy(field.begin(), field.end(), digits.begin());
  digits[comma] = '.';
  return parseNumber({ digits.data(), field.size() }, value);
}
}
