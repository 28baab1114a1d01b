// SPDX-License-Identifier: BSD-3-Clause
#include "file/PwnFile.h"

#include "base/OneLine.h"
#include "file/InputFile.h"
#include "file/Words.h"

#include <limits>

namespace neuralmesh
{
namespace
{
/// Takes three numbers off a line.
Eigen::Vector3d takeVector(const InputFile& file, std::string_view& line, const std::string& what)
{
  Eigen::Vector3d vector;
  if (!takeNumbers(line, 3, vector.data()))
  {
    throw file.errorInLine("this is no " + what + ": " + oneLine(file.line()));
  }
  return vector;
}

bool hasMoreWords(std::string_view line)
{
  const std::string_view word = takeWord(line);
  return !word.empty() && word.front() != '#';
}
}

FileContents readPwn(const std::string& path)
{
  InputFile file(path);
  FileContents contents;
  if (!file.nextFilledLine())
  {
    throw file.error("there are no points in it");
  }
  std::string_view line = file.line();
  std::uint64_t announced = 0;
  const bool hasCount = parseCount(takeWord(line), announced) && !hasMoreWords(line);
  bool isPoint = !hasCount || file.nextFilledLine();
  std::string_view first = file.line();
  const bool isSeparate =
    hasCount && (!isPoint || (takeVector(file, first, "point"), !hasMoreWords(first)));
  const std::uint64_t wanted = hasCount ? announced : std::numeric_limits<std::uint64_t>::max();
  for (; isPoint && contents.size() < wanted; isPoint = file.nextFilledLine())
  {
    line = file.line();
    contents.addPoint(takeVector(file, line, "point"));
    if (!isSeparate)
    {
      contents.normals.emplace_back(takeVector(file, line, "point with its normal").cast<float>());
    }
  }
  if (hasCount && contents.size() < announced)
  {
    throw file.error("damaged: it ends before its last point");
  }
  for (; isSeparate && isPoint && contents.normals.size() < wanted; isPoint = file.nextFilledLine())
  {
    line = file.line();
    contents.normals.emplace_back(takeVector(file, line, "normal").cast<float>());
  }
  if (contents.normals.size() < contents.size())
  {
    throw file.error("damaged: it ends before its last normal");
  }
  return contents;
}
}
