// SPDX-License-Identifier: BSD-3-Clause
#include "OneLine.h"

namespace
{
constexpr std::size_t LongestText = 300;

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool IsShown(char c) { return c > ' ' && c <= '~'; }
}

std::string OneLine(const std::string& text)
{
  std::string line;
  for (const char c : text)
  {
    if (line.size() >= LongestText)
    {
      return line + "...";
    }
    if (!IsBlank(c))
    {
      line += IsShown(c) ? c : '?';
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
