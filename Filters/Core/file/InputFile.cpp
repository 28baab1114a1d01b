// SPDX-License-Identifier: BSD-3-Clause
#include "file/InputFile.h"

#include "file/Words.h"

#include <algorithm>

namespace neuralmesh
{
InputFile::InputFile(const std::string& path)
  : path_(path)
  , file_(path, std::ios::binary)
{
  if (!file_)
  {
    throw error("cannot be opened for reading");
  }
  file_.seekg(0, std::ios::end);
  size_ = std::uint64_t(std::max<std::streamoff>(file_.tellg(), 0));
  file_.clear();
  file_.seekg(0);
}

bool InputFile::nextLine()
{
  if (!std::getline(file_, line_))
  {
    if (file_.bad())
    {
      throw error("reading failed");
    }
    return false;
  }
  ++lineNumber_;
  // Some programs begin text with a mark of its encoding.
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (lineNumber_ == 1 && line_.starts_with(mark))
  {
    line_.erase(0, mark.size());
  }
  return true;
}

bool InputFile::nextFilledLine()
{
  while (nextLine())
  {
    std::string_view line = line_;
    const std::string_view word = takeWord(line);
    if (!word.empty() && word.front() != '#')
    {
      return true;
    }
  }
  return false;
}

std::string InputFile::rest()
{
  const auto begin = std::uint64_t(std::max<std::streamoff>(file_.tellg(), 0));
  std::string bytes(std::size_t(size_ - std::min(begin, size_)), '\0');
  file_.read(bytes.data(), std::streamsize(bytes.size()));
  if (file_.bad() || std::size_t(file_.gcount()) != bytes.size())
  {
    throw error("it cannot be read to its end");
  }
  return bytes;
}

std::runtime_error InputFile::error(const std::string& what) const
{
  return std::runtime_error(path_ + ": " + what);
}

std::runtime_error InputFile::errorInLine(const std::string& what) const
{
  return std::runtime_error(path_ + ", line " + std::to_string(lineNumber_) + ": " + what);
}
}
