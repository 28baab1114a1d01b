// SPDX-License-Identifier: BSD-3-Clause
#include "file/OffFile.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "file/InputFile.h"
#include "file/PointText.h"
#include "file/Words.h"

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
struct OffHeader
{
  bool hasTexture = false;
  bool hasColor = false;
  bool hasNormal = false;
  std::uint64_t points = 0;
  std::uint64_t faces = 0;
};

/// What stands before OFF. Throws std::runtime_error if it is none.
void readKind(const InputFile& file, std::string_view word, OffHeader& header)
{
  std::string_view kind = word.substr(0, word.size() - 3);
  const auto takes = [&kind](std::string_view letters)
  {
    const bool isThere = kind.starts_with(letters);
    kind.remove_prefix(isThere ? letters.size() : 0);
    return isThere;
  };
  header.hasTexture = takes("ST");
  header.hasColor = takes("C");
  header.hasNormal = takes("N");
  if (!kind.empty())
  {
    throw file.errorInLine("this kind of .off is not read: " + oneLine(word));
  }
}

/// The next line that is no comment; a shift that comments note is kept.
bool nextOffLine(InputFile& file, FileContents& contents)
{
  while (file.nextLine())
  {
    std::string_view line = file.line();
    if (line.starts_with("# ") && !contents.shift)
    {
      contents.shift = shiftOfComment(line.substr(2));
    }
    const std::string_view word = takeWord(line);
    if (!word.empty() && word.front() != '#')
    {
      return true;
    }
  }
  return false;
}

OffHeader readOffHeader(InputFile& file, FileContents& contents)
{
  OffHeader header;
  if (!nextOffLine(file, contents))
  {
    throw file.error("this is no .off: it is empty");
  }
  std::string_view line = file.line();
  std::string_view word = takeWord(line);
  if (word.ends_with("OFF"))
  {
    readKind(file, word, header);
    word = takeWord(line);
    if (word == "BINARY")
    {
      throw file.error("a binary .off is not read; convert it to text");
    }
    if (word.empty() || word.front() == '#')
    {
      if (!nextOffLine(file, contents))
      {
        throw file.error("damaged: its header does not end");
      }
      line = file.line();
      word = takeWord(line);
    }
  }
  if (!parseCount(word, header.points) || !parseCount(takeWord(line), header.faces))
  {
    throw file.errorInLine("these are no numbers of points and faces: " + oneLine(file.line()));
  }
  return header;
}

/// Of words that are all whole numbers up to 255, or all parts of one.
std::array<std::uint8_t, 3> readColor(const InputFile& file, std::string_view line)
{
  std::array<double, 3> parts{};
  std::string_view words = line;
  if (!takeNumbers(words, parts.size(), parts.data()))
  {
    throw file.errorInLine("damaged: the colour of a point is missing");
  }
  const bool isWhole = line.substr(0, line.find('#')).find('.') == std::string_view::npos;
  std::array<std::uint8_t, 3> color{};
  for (std::size_t i = 0; i < color.size(); ++i)
  {
    const double part = isWhole ? parts[i] : 255. * parts[i];
    color[i] = std::isfinite(part) ? std::uint8_t(std::lround(std::clamp(part, 0., 255.))) : 0;
  }
  return color;
}

void readOffPoint(const InputFile& file, const OffHeader& header, FileContents& contents)
{
  std::string_view line = file.line();
  Eigen::Vector3d point, normal;
  if (!takeNumbers(line, 3, point.data()) ||
    (header.hasNormal && !takeNumbers(line, 3, normal.data())))
  {
    throw file.errorInLine("this is no point: " + oneLine(file.line()));
  }
  contents.addPoint(point);
  if (header.hasNormal)
  {
    contents.normals.emplace_back(normal.cast<float>());
  }
  if (header.hasColor)
  {
    contents.colors.push_back(readColor(file, line));
  }
}

void readOffFace(const InputFile& file, FileContents& contents)
{
  std::string_view line = file.line();
  std::uint64_t count = 0;
  bool isSound = parseCount(takeWord(line), count);
  std::vector<std::uint64_t> corners;
  for (std::uint64_t i = 0; i < count && isSound; ++i)
  {
    isSound = parseCount(takeWord(line), corners.emplace_back());
  }
  if (!isSound)
  {
    throw file.errorInLine("damaged: this is no face: " + oneLine(file.line()));
  }
  contents.addPolygon(corners, contents.size());
}
}

FileContents readOff(const std::string& path)
{
  InputFile file(path);
  FileContents contents;
  const OffHeader header = readOffHeader(file, contents);
  for (std::uint64_t i = 0; i < header.points; ++i)
  {
    if (!nextOffLine(file, contents))
    {
      throw file.error("damaged: it ends before its last point");
    }
    readOffPoint(file, header, contents);
  }
  for (std::uint64_t i = 0; i < header.faces; ++i)
  {
    if (!nextOffLine(file, contents))
    {
      throw file.error("damaged: it ends before its last face");
    }
    readOffFace(file, contents);
  }
  return contents;
}

std::string offOf(const FileContents& contents)
{
  std::string text = contents.colors.empty() ? "OFF\n" : "COFF\n";
  if (contents.shift)
  {
    text += "# " + commentOfShift(*contents.shift) + "\n";
  }
  text +=
    std::to_string(contents.size()) + " " + std::to_string(contents.triangles.size()) + " 0\n";
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    text += pointTextOf(contents, i);
    if (!contents.colors.empty())
    {
      for (const std::uint8_t part : contents.colors[i])
      {
        text.append(" ").append(std::to_string(part));
      }
      text += " 255";
    }
    text += "\n";
  }
  for (const auto& [a, b, c] : contents.triangles)
  {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  }
  return text;
}
}
