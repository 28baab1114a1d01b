// SPDX-License-Identifier: BSD-3-Clause
#include "PointTextReader.h"

#include "OneLine.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace
{
bool IsSeparator(char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; }

/** The next word of a line, which is taken off it; empty at its end. */
std::string_view TakeWord(std::string_view& line)
{
  std::size_t begin = 0;
  while (begin < line.size() && IsSeparator(line[begin]))
  {
    ++begin;
  }
  std::size_t end = begin;
  while (end < line.size() && !IsSeparator(line[end]))
  {
    ++end;
  }
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

bool ParseNumber(std::string_view word, double& number)
{
  if (!word.empty() && word.front() == '+')
  {
    word.remove_prefix(1);
  }
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return !word.empty() && error == std::errc() && end == word.data() + word.size();
}

bool IsComment(std::string_view word)
{
  return word.empty() || word.front() == '#' || word.starts_with("//");
}

std::size_t WordsBeforeComment(std::string_view line)
{
  std::size_t words = 0;
  while (!IsComment(TakeWord(line)))
  {
    ++words;
  }
  return words;
}

/** The error that a line is not as it should be. */
std::runtime_error ErrorIn(const std::string& path, std::size_t lineNumber, const std::string& what)
{
  return std::runtime_error(path + ", line " + std::to_string(lineNumber) + ": " + what);
}
}

vtkSmartPointer<vtkPolyData> ReadPointText(const std::string& path)
{
  std::ifstream file(path);
  if (!file)
  {
    throw std::runtime_error(path + ": cannot be opened for reading");
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::string text, lastPoint;
  std::size_t lineNumber = 0;
  double announced = 0.0;
  for (; std::getline(file, text); ++lineNumber)
  {
    std::string_view line = text;
    const std::string_view first = TakeWord(line);
    if (IsComment(first))
    {
      continue;
    }
    const std::string_view second = TakeWord(line);
    const std::string_view third = TakeWord(line);
    std::array<double, 3> point{};
    if (ParseNumber(first, point[0]) && ParseNumber(second, point[1]) &&
      ParseNumber(third, point[2]))
    {
      if (file.eof() && WordsBeforeComment(text) < WordsBeforeComment(lastPoint))
      {
        throw ErrorIn(path, lineNumber + 1, "the file ends in the middle of it");
      }
      points->InsertNextPoint(point.data());
      lastPoint.swap(text);
      continue;
    }
    double number = 0.0;
    const bool isCount = ParseNumber(first, number) && second.empty();
    const bool isNames = !ParseNumber(first, number) && !third.empty();
    if (points->GetNumberOfPoints() > 0 || !(isCount || isNames))
    {
      throw ErrorIn(path, lineNumber + 1, "this is not a point: " + OneLine(text));
    }
    announced = isCount ? number : announced;
  }
  if (file.bad())
  {
    throw std::runtime_error(path + ": reading failed");
  }
  if (static_cast<double>(points->GetNumberOfPoints()) < announced)
  {
    throw std::runtime_error(path + ": damaged: it ends before its last point");
  }
  auto polyData = vtkSmartPointer<vtkPolyData>::New();
  polyData->SetPoints(points);
  return polyData;
}
