// SPDX-License-Identifier: BSD-3-Clause
#include "base/OneLine.h"

namespace neuralmesh
{
namespace
{
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

bool isShown(char c) { return c > ' ' && c <= '~'; }
}

std::string oneLine(std::string_view text, std::size_t most)
{
  std::string line;
  while (!text.empty() && isBlank(text.back()))
  {
    text.remove_suffix(1);
  }
  for (const char c : text)
  {
    if (line.size() >= most)
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
  return line;
}
}
