// SPDX-License-Identifier: BSD-3-Clause
#include "file/PointText.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "file/InputFile.h"
#include "file/Words.h"

namespace neuralmesh
{
namespace
{
bool isComment(std::string_view word)
{
  return word.empty() || word.front() == '#' || word.starts_with("//");
}

std::size_t wordsBeforeComment(std::string_view line)
{
  std::size_t words = 0;
  while (!isComment(takeWord(line)))
  {
    ++words;
  }
  return words;
}

void noteShift(std::string_view line, FileContents& contents)
{
  if (line.starts_with("# ") && !contents.shift)
  {
    contents.shift = shiftOfComment(line.substr(2));
  }
}
}

FileContents readPointText(const std::string& path)
{
  InputFile file(path);
  FileContents contents;
  std::string lastPoint;
  double announced = 0.;
  while (file.nextLine())
  {
    std::string_view line = file.line();
    const std::string_view first = takeWord(line);
    if (isComment(first))
    {
      noteShift(file.line(), contents);
      continue;
    }
    const std::string_view second = takeWord(line);
    const std::string_view third = takeWord(line);
    Eigen::Vector3d point;
    if (parseNumber(first, point[0]) && parseNumber(second, point[1]) &&
      parseNumber(third, point[2]))
    {
      if (file.isLastWithoutEnd() &&
        wordsBeforeComment(file.line()) < wordsBeforeComment(lastPoint))
      {
        throw file.errorInLine("the file ends in the middle of it");
      }
      contents.addPoint(point);
      lastPoint = file.line();
      continue;
    }
    double number = 0.;
    const bool isCount = parseNumber(first, number) && second.empty();
    const bool isNames = !parseNumber(first, number) && !third.empty();
    if (contents.size() > 0 || !(isCount || isNames))
    {
      throw file.errorInLine("this is not a point: " + oneLine(file.line()));
    }
    announced = isCount ? number : announced;
  }
  if (double(contents.size()) < announced)
  {
    throw file.error("damaged: it ends before its last point");
  }
  return contents;
}

std::string pointTextOf(const FileContents& contents, std::size_t point)
{
  const auto text = [i = 3 * point](const auto& numbers)
  { return textOf(numbers[i]) + " " + textOf(numbers[i + 1]) + " " + textOf(numbers[i + 2]); };
  return contents.floats.empty() ? text(contents.doubles) : text(contents.floats);
}

std::string pointTextOf(const FileContents& contents)
{
  std::string text;
  if (contents.shift)
  {
    text = "# " + commentOfShift(*contents.shift) + "\n";
  }
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    text += pointTextOf(contents, i);
    for (Eigen::Index axis = 0; axis < 3 && !contents.normals.empty(); ++axis)
    {
      text += ' ';
      text += textOf(contents.normals[i][axis]);
    }
    text += '\n';
  }
  return text;
}
}
