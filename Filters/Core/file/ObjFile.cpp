// SPDX-License-Identifier: BSD-3-Clause
#include "file/ObjFile.h"

#include "base/OneLine.h"
#include "cloud/PlyContents.h"
#include "file/InputFile.h"
#include "file/PointText.h"
#include "file/Words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
constexpr std::uint64_t NoNormal = std::numeric_limits<std::uint64_t>::max();

class ObjReader
{
public:
  explicit ObjReader(const std::string& path)
    : file_(path)
  {
  }

  FileContents read()
  {
    while (file_.nextLine())
    {
      std::string text = file_.line();
      while (text.ends_with('\\') || text.ends_with("\\\r"))
      {
        text.resize(text.rfind('\\'));
        if (!file_.nextLine())
        {
          throw file_.error("damaged: it ends within a line");
        }
        text += " " + file_.line();
      }
      readLine(text);
    }
    addNormals();
    if (contents_.colors.size() != contents_.size())
    {
      contents_.colors.clear();
    }
    return std::move(contents_);
  }

private:
  void readLine(std::string_view text)
  {
    contents_.shift = text.starts_with("# ") ? shiftOfComment(text.substr(2)) : contents_.shift;
    std::string_view line = text;
    const std::string_view word = takeWord(line);
    if (word == "v")
    {
      readPoint(line);
    }
    else if (word == "vn")
    {
      normals_.push_back(vector(line).cast<float>());
    }
    else if (word == "f")
    {
      readFace(line);
    }
    else if (!word.starts_with('#') &&
      std::any_of(word.begin(), word.end(), [](char c) { return c <= ' ' || c > '~'; }))
    {
      throw file_.errorInLine("this is no .obj: " + oneLine(text));
    }
  }

  Eigen::Vector3d vector(std::string_view& line) const
  {
    Eigen::Vector3d numbers;
    if (!takeNumbers(line, 3, numbers.data()))
    {
      throw file_.errorInLine("damaged: these are not three numbers: " + oneLine(file_.line()));
    }
    return numbers;
  }

  void readPoint(std::string_view line)
  {
    contents_.addPoint(vector(line));
    std::array<double, 3> parts{};
    if (takeNumbers(line, 3, parts.data()))
    {
      auto& color = contents_.colors.emplace_back();
      std::transform(parts.begin(), parts.end(), color.begin(),
        [](double part)
        {
          return std::isfinite(part) ? std::uint8_t(std::lround(255. * std::clamp(part, 0., 1.)))
                                     : std::uint8_t(0);
        });
    }
  }

  /// Numbers from 1 on, or backwards from -1 on; without them none.
  std::uint64_t indexOf(std::string_view word, std::uint64_t count) const
  {
    std::int64_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc() || end != word.data() + word.size() || index == 0)
    {
      throw file_.errorInLine("damaged: this is no face: " + oneLine(file_.line()));
    }
    const std::int64_t place = index > 0 ? index - 1 : std::int64_t(count) + index;
    if (place < 0 || std::uint64_t(place) >= count)
    {
      throw file_.errorInLine("damaged: a face has a point or a normal that does not exist");
    }
    return std::uint64_t(place);
  }

  void readFace(std::string_view line)
  {
    std::vector<std::uint64_t> corners;
    for (std::string_view word = takeWord(line); !word.empty() && word.front() != '#';
         word = takeWord(line))
    {
      const std::size_t first = std::min(word.find('/'), word.size());
      corners.push_back(indexOf(word.substr(0, first), contents_.size()));
      const std::size_t second = word.find('/', first + 1);
      if (second != std::string_view::npos && second + 1 < word.size())
      {
        const std::uint64_t normal = indexOf(word.substr(second + 1), normals_.size());
        normalOf_.resize(std::max<std::size_t>(normalOf_.size(), corners.back() + 1), NoNormal);
        std::uint64_t& known = normalOf_[corners.back()];
        known = known == NoNormal ? normal : known;
      }
    }
    if (corners.size() < 3)
    {
      throw file_.errorInLine("damaged: a face lacks a point");
    }
    contents_.addPolygon(corners, contents_.size());
  }

  void addNormals()
  {
    const std::size_t count = contents_.size();
    if (contents_.triangles.empty() && normals_.size() == count)
    {
      contents_.normals = normals_;
    }
    const bool areKnown = normalOf_.size() == count &&
      std::none_of(
        normalOf_.begin(), normalOf_.end(), [](auto normal) { return normal == NoNormal; });
    for (std::size_t i = 0; i < count && areKnown; ++i)
    {
      contents_.normals.push_back(normals_[normalOf_[i]]);
    }
  }

  InputFile file_;
  FileContents contents_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<std::uint64_t> normalOf_; ///< each point, or NoNormal
};
}

FileContents readObj(const std::string& path) { return ObjReader(path).read(); }

std::string objOf(const FileContents& contents)
{
  std::string text;
  for (std::size_t i = 0; i < contents.size(); ++i)
  {
    text += "v " + pointTextOf(contents, i) + "\n";
  }
  for (const Eigen::Vector3f& normal : contents.normals)
  {
    text += "vn " + textOf(normal[0]) + " " + textOf(normal[1]) + " " + textOf(normal[2]) + "\n";
  }
  for (const auto& triangle : contents.triangles)
  {
    text += "f";
    for (const std::uint32_t corner : triangle)
    {
      const std::string number = std::to_string(std::uint64_t(corner) + 1);
      text += " " + number;
      if (!contents.normals.empty())
      {
        text += "//" + number;
      }
    }
    text += "\n";
  }
  if (contents.shift)
  {
    text += "# " + commentOfShift(*contents.shift) + "\n";
  }
  return text;
}
}
