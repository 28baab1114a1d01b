// SPDX-License-Identifier: BSD-3-Clause
#include "file/WriteMesh.h"

#include "base/AtomicFile.h"
#include "file/FileExtension.h"
#include "file/GlbFile.h"
#include "file/ObjFile.h"
#include "file/OffFile.h"
#include "file/PlyFile.h"
#include "file/PointText.h"
#include "file/StlFile.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
/// Of so many points, or a few more, spread over all of them.
constexpr std::size_t PointsOfRange = 100000;

using Encode = std::string (*)(const FileContents&);

const std::map<std::string, Encode>& encoders()
{
  static const std::map<std::string, Encode> all{ { ".ply", plyOf }, { ".obj", objOf },
    { ".stl", stlOf }, { ".off", offOf }, { ".glb", glbOf },
    { ".xyz", [](const FileContents& contents) { return pointTextOf(contents); } } };
  return all;
}

CoordinateRange rangeOfContents(const FileContents& contents)
{
  const PointSpans points = contents.points();
  const std::size_t step = 1 + points.size() / PointsOfRange;
  std::vector<Eigen::Vector3d> some;
  for (std::size_t i = 0; i < points.size(); i += step)
  {
    some.push_back(points[i]);
  }
  return CoordinateRange(some);
}

void requireSound(const FileContents& contents)
{
  const std::size_t points = contents.size();
  const auto isEach = [points](const auto& values)
  { return values.empty() || values.size() == points; };
  if (points == 0)
  {
    throw std::runtime_error("there are no points to write");
  }
  if (!isEach(contents.normals) || !isEach(contents.colors))
  {
    throw std::runtime_error("there are not as many normals or colours as points");
  }
  for (const auto& triangle : contents.triangles)
  {
    if (*std::max_element(triangle.begin(), triangle.end()) >= points)
    {
      throw std::runtime_error("a triangle has a point that does not exist");
    }
  }
}
}

Eigen::Vector3d writeMesh(
  const std::string& path, const FileContents& contents, const WritingOptions& options)
{
  const std::string extension = fileExtension(path);
  if (!encoders().contains(extension))
  {
    throw std::runtime_error(
      path + ": unknown extension; writable are .ply .obj .stl .off .glb .xyz");
  }
  const CoordinateRange range = rangeOfContents(contents);
  const bool isDouble = !contents.doubles.empty();
  const Eigen::Vector3d automatic =
    isDouble ? range.roundShift(contents.size()) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  const Eigen::Vector3d shift = options.isShiftAutomatic ? automatic : options.shift;
  if (!shift.allFinite())
  {
    throw std::runtime_error(path + ": cannot be written: the shift is not finite");
  }
  FileContents shifted = contents;
  if (!shift.isZero(0.))
  {
    shifted.move(-shift);
    shifted.shift = shift + contents.shift.value_or(Eigen::Vector3d::Zero());
  }
  if (shifted.shift && shifted.shift->isZero(0.))
  {
    shifted.shift.reset();
  }
  if (isDouble)
  {
    requireDigits(path, range, contents.size(), shift);
  }
  if (!shifted.doubles.empty() && extension == ".ply" &&
    (!isDouble || range.fitsFloats(contents.size(), shift)))
  {
    shifted.floats.assign(shifted.doubles.begin(), shifted.doubles.end());
    shifted.doubles.clear();
  }
  writeAtomicFile(path,
    [&](const std::string& temporary) { writeText(meshBytesOf(extension, shifted), temporary); });
  return shifted.shift.value_or(Eigen::Vector3d::Zero());
}

std::string meshBytesOf(const std::string& extension, const FileContents& contents)
{
  requireSound(contents);
  return encoders().at(extension)(contents);
}

bool hasOnlyFloats(const std::string& extension)
{
  return extension == ".stl" || extension == ".glb";
}

void requireDigits(const std::string& path, const CoordinateRange& range, std::size_t vertices,
  const Eigen::Vector3d& shift)
{
  const std::string extension = fileExtension(path);
  if (hasOnlyFloats(extension) && !range.fitsFloats(vertices, shift))
  {
    std::ostringstream text;
    text.precision(2);
    text << path << ": cannot be written: " << extension << " has floats only, which are "
         << range.floatStep(shift) << " apart at these coordinates, for edges of about "
         << range.edgeLength(vertices)
         << "; write .ply, .vtp or .obj, or shift the mesh (--shift auto)";
    throw std::runtime_error(text.str());
  }
}
}
