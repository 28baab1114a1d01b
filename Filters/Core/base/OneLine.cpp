// SPDX-License-Identifier: BSD-3-Clause
#include "base/OneLine.h"

namespace neuralmesh
{
namespace
{
constexpr std::size_t LongestText = 300;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool isShown(char c) { return c > ' ' && c <= '~'; }
}

std::string oneLine(std::string_view text)
{
  std::string line;
  for (const char c : text)
  {
    if (line.size() >= LongestText)
    {
      return line + "...";
    }
    if (!isBlank(c))
    {
      line += isShown(c) ? c : '?';
    }
    else if (!line.empty() && line.back() != ' ')
    {
      line += ' ';
    }
  }
  if (!line.empty() && line.back() == ' ')
  {
    line.pop_back();
  }
  return line;
}
}
