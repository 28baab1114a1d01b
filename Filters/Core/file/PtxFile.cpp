// SPDX-License-Identifier: BSD-3-Clause
#include "file/PtxFile.h"

#include "base/OneLine.h"
#include "cloud/PlyHeader.h"
#include "file/InputFile.h"
#include "file/Words.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace neuralmesh
{
namespace
{
struct PtxScan
{
  std::uint64_t size = 0; ///< of its grid
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
};

void requireLine(InputFile& file)
{
  if (!file.nextFilledLine())
  {
    throw file.error("damaged: it ends within a scan");
  }
}

void readRow(InputFile& file, std::size_t count, double* numbers)
{
  requireLine(file);
  std::string_view line = file.line();
  if (!takeNumbers(line, count, numbers))
  {
    throw file.errorInLine("this is no line of the header of a .ptx: " + oneLine(file.line()));
  }
}

std::uint64_t countInLine(const InputFile& file)
{
  std::string_view line = file.line();
  std::uint64_t count = 0;
  if (!parseCount(takeWord(line), count) || !takeWord(line).empty())
  {
    throw file.errorInLine(
      "this is no number of columns or rows of a .ptx: " + oneLine(file.line()));
  }
  return count;
}

/// From the line of the columns on.
PtxScan readScanHeader(InputFile& file)
{
  PtxScan scan;
  const std::uint64_t columns = countInLine(file);
  requireLine(file);
  scan.size = behind(0, columns, countInLine(file));
  Eigen::Vector3d place, axis;
  readRow(file, 3, place.data());
  for (int i = 0; i < 3; ++i)
  {
    readRow(file, 3, axis.data());
  }
  // Its lines are those of the transposed matrix.
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < 4; ++i)
  {
    readRow(file, 4, matrix.col(i).data());
  }
  if (!matrix.allFinite() || !place.allFinite())
  {
    throw file.errorInLine("damaged: the place of a scan is not finite");
  }
  scan.matrix.affine() = matrix.topRows<3>();
  scan.place = matrix.topRows<3>().isIdentity(0.) ? place : matrix.topRightCorner<3, 1>().eval();
  return scan;
}

/// The colour behind the intensity.
std::array<std::uint8_t, 3> takeColor(std::string_view line)
{
  std::array<double, 3> parts{};
  std::array<std::uint8_t, 3> color{};
  if (takeNumbers(line, parts.size(), parts.data()))
  {
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      color[i] =
        std::isfinite(parts[i]) ? std::uint8_t(std::lround(std::clamp(parts[i], 0., 255.))) : 0;
    }
  }
  return color;
}

std::size_t numberOfWords(std::string_view line)
{
  std::size_t words = 0;
  while (!takeWord(line).empty())
  {
    ++words;
  }
  return words;
}

void readScanPoints(InputFile& file, const PtxScan& scan, FileContents& contents)
{
  constexpr std::size_t withColors = 7;
  const auto view = std::uint32_t(contents.viewpoints.size());
  std::size_t words = 0;
  for (std::uint64_t i = 0; i < scan.size; ++i)
  {
    requireLine(file);
    std::string_view line = file.line();
    Eigen::Vector3d point;
    double intensity = 0.;
    const std::size_t found = numberOfWords(line);
    words = i == 0 ? found : words;
    if (!takeNumbers(line, 3, point.data()) ||
      (found > 3 && !parseNumber(takeWord(line), intensity)) || found < words)
    {
      throw file.errorInLine("damaged: this is no point of a .ptx: " + oneLine(file.line()));
    }
    if (point.isZero(0.))
    {
      ++contents.missingReturns;
      continue;
    }
    if (found >= withColors && contents.colors.empty())
    {
      contents.colors.resize(contents.size());
    }
    if (found >= withColors || !contents.colors.empty())
    {
      contents.colors.push_back(takeColor(line));
    }
    contents.addPoint(scan.matrix * point);
    contents.arrays.front().values.push_back(intensity);
    contents.views.push_back(view);
  }
  contents.viewpoints.push_back(scan.place);
}
}

FileContents readPtx(const std::string& path)
{
  InputFile file(path);
  FileContents contents;
  contents.arrays.push_back({ "Intensity", 1, {} });
  while (file.nextFilledLine())
  {
    readScanPoints(file, readScanHeader(file), contents);
  }
  if (contents.viewpoints.empty())
  {
    throw file.error("there is no scan in it");
  }
  return contents;
}
}
