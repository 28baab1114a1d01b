// SPDX-License-Identifier: BSD-3-Clause
#include "file/GlbFile.h"

#include "file/Bytes.h"
#include "file/Words.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace neuralmesh
{
namespace
{
// As glTF has them.
constexpr int TypeUshort = 5123, TypeUint = 5125, TypeFloat = 5126;
constexpr int TargetVertices = 34962, TargetIndices = 34963;
constexpr int ModePoints = 0, ModeTriangles = 4;
constexpr std::size_t ChunkHeaderSize = 8, GlbHeaderSize = 12;

/// Of an sRGB value, as 16 bits.
std::uint16_t linearOf(std::uint8_t part)
{
  const double value = double(part) / 255.;
  const double linear = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
  return std::uint16_t(std::lround(65535. * linear));
}

Eigen::Vector3f unitNormal(const Eigen::Vector3f& normal)
{
  const Eigen::Vector3d unit = normal.cast<double>().stableNormalized();
  return unit.allFinite() && !unit.isZero(0.5) ? Eigen::Vector3f(unit.cast<float>())
                                               : Eigen::Vector3f(0.f, 0.f, 1.f);
}

template <typename Vector>
std::string jsonListOf(const Vector& vector)
{
  std::string list("[");
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    list.append(axis == 0 ? "" : ",").append(textOf(vector[axis]));
  }
  return list.append("]");
}

/// The numbers, and what tells where which are.
class GlbBuffer
{
public:
  /// Adds what `bytes` has grown by since the last one. Returns its number.
  std::size_t add(
    std::size_t count, int type, const std::string& shape, int target, const std::string& more = "")
  {
    const std::string separator = number_ == 0 ? "" : ",";
    const std::string number = std::to_string(number_);
    views_ += separator + "{\"buffer\":0,\"byteOffset\":" + std::to_string(end_) +
      ",\"byteLength\":" + std::to_string(bytes.size() - end_) +
      ",\"target\":" + std::to_string(target) + "}";
    accessors_ += separator + "{\"bufferView\":" + number +
      ",\"componentType\":" + std::to_string(type) + ",\"count\":" + std::to_string(count) +
      ",\"type\":\"" + shape + "\"" + more + "}";
    end_ = bytes.size();
    return number_++;
  }
  std::string json() const
  {
    return "\"accessors\":[" + accessors_ + "],\"bufferViews\":[" + views_ +
      "],\"buffers\":[{\"byteLength\":" + std::to_string(bytes.size()) + "}]";
  }

  std::string bytes; ///< each part is a multiple of four

private:
  std::string views_;
  std::string accessors_;
  std::size_t number_ = 0;
  std::size_t end_ = 0;
};

std::size_t addPositions(const FileContents& contents, GlbBuffer& buffer)
{
  const PointSpans points = contents.points();
  Eigen::Vector3f lowest = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f highest = -lowest;
  points.forEach(0, points.size(),
    [&](std::size_t, const Eigen::Vector3d& point)
    {
      const Eigen::Vector3f rounded = point.cast<float>();
      if (!rounded.allFinite())
      {
        throw std::runtime_error("a point is not finite");
      }
      lowest = lowest.cwiseMin(rounded);
      highest = highest.cwiseMax(rounded);
      appendBytes(buffer.bytes, rounded.data(), 3);
    });
  return buffer.add(points.size(), TypeFloat, "VEC3", TargetVertices,
    ",\"min\":" + jsonListOf(lowest) + ",\"max\":" + jsonListOf(highest));
}

std::string primitiveOf(const FileContents& contents, GlbBuffer& buffer)
{
  const std::size_t count = contents.size();
  std::string attributes = "\"POSITION\":" + std::to_string(addPositions(contents, buffer));
  if (!contents.normals.empty())
  {
    for (const Eigen::Vector3f& normal : contents.normals)
    {
      appendBytes(buffer.bytes, unitNormal(normal).data(), 3);
    }
    attributes +=
      ",\"NORMAL\":" + std::to_string(buffer.add(count, TypeFloat, "VEC3", TargetVertices));
  }
  if (!contents.colors.empty())
  {
    for (const auto& [red, green, blue] : contents.colors)
    {
      // With opacity, as each vertex must begin at a multiple of four.
      const std::array<std::uint16_t, 4> color{ linearOf(red), linearOf(green), linearOf(blue),
        std::numeric_limits<std::uint16_t>::max() };
      appendBytes(buffer.bytes, color.data(), color.size());
    }
    attributes += ",\"COLOR_0\":" +
      std::to_string(buffer.add(count, TypeUshort, "VEC4", TargetVertices, ",\"normalized\":true"));
  }
  std::string primitive = "{\"attributes\":{" + attributes + "},\"material\":0";
  if (contents.triangles.empty())
  {
    return primitive + ",\"mode\":" + std::to_string(ModePoints) + "}";
  }
  for (const auto& triangle : contents.triangles)
  {
    appendBytes(buffer.bytes, triangle.data(), triangle.size());
  }
  const std::size_t indices =
    buffer.add(3 * contents.triangles.size(), TypeUint, "SCALAR", TargetIndices);
  return primitive + ",\"indices\":" + std::to_string(indices) +
    ",\"mode\":" + std::to_string(ModeTriangles) + "}";
}

void appendChunk(std::string& glb, const std::string& type, const std::string& bytes)
{
  const auto size = std::uint32_t(bytes.size());
  appendBytes(glb, &size, 1);
  glb += type + bytes;
}
}

std::string glbOf(const FileContents& contents)
{
  GlbBuffer buffer;
  const std::string primitive = primitiveOf(contents, buffer);
  std::string json = R"({"asset":{"version":"2.0","generator":"NeuralMesh")";
  if (contents.shift)
  {
    json += ",\"extras\":{\"shift\":" + jsonListOf(*contents.shift) + "}";
  }
  json += R"(},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"materials":[{)"
          R"("pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1},"doubleSided":true}],)"
          R"("meshes":[{"primitives":[)" +
    primitive + "]}]," + buffer.json() + "}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::uint64_t size =
    std::uint64_t(GlbHeaderSize) + 2 * ChunkHeaderSize + json.size() + buffer.bytes.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
  {
    throw std::runtime_error("a .glb of more than 4 GiB cannot be");
  }
  const std::array<std::uint32_t, 2> head{ 2, std::uint32_t(size) };
  std::string glb = "glTF";
  appendBytes(glb, head.data(), head.size());
  appendChunk(glb, "JSON", json);
  appendChunk(glb, std::string("BIN\0", 4), buffer.bytes);
  return glb;
}
}
