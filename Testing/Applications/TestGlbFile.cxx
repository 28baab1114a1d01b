// SPDX-License-Identifier: BSD-3-Clause
#include "FileTest.h"
#include "JSON.h"
#include "MeshWriter.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>

namespace
{
using GlbFile = FileTest;
using Json = nlohmann::json;

/** What a file says that the specification of glTF 2.0 lets us look after; failures are those of the test. */
class Glb
{
public:
  explicit Glb(const std::string& path)
  {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(this->Number<std::uint32_t>(bytes, 4), 2u);
    EXPECT_EQ(this->Number<std::uint32_t>(bytes, 8), bytes.size());
    const auto jsonSize = this->Number<std::uint32_t>(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(jsonSize % 4, 0u);
    this->Document = Json::parse(bytes.substr(20, jsonSize));
    const std::size_t binary = 20 + jsonSize;
    const auto binarySize = this->Number<std::uint32_t>(bytes, binary);
    EXPECT_EQ(bytes.substr(binary + 4, 4), std::string("BIN\0", 4));
    EXPECT_EQ(binarySize % 4, 0u);
    EXPECT_EQ(binary + 8 + binarySize, bytes.size());
    this->Buffer = bytes.substr(binary + 8);
    EXPECT_EQ(this->Document["asset"]["version"], "2.0");
    EXPECT_EQ(this->Document["buffers"][0]["byteLength"], this->Buffer.size());
    this->CheckAccessors();
  }

  const Json& Primitive() const { return this->Document["meshes"][0]["primitives"][0]; }

  /** The numbers of an accessor. */
  template <typename NumberT>
  std::vector<NumberT> NumbersOf(std::size_t accessor) const
  {
    const Json& told = this->Document["accessors"][accessor];
    const Json& view = this->Document["bufferViews"][told["bufferView"].get<std::size_t>()];
    std::vector<NumberT> numbers(view["byteLength"].get<std::size_t>() / sizeof(NumberT));
    std::memcpy(numbers.data(), this->Buffer.data() + view["byteOffset"].get<std::size_t>(),
      view["byteLength"].get<std::size_t>());
    return numbers;
  }

  Json Document;
  std::string Buffer;

private:
  template <typename NumberT>
  static NumberT Number(const std::string& bytes, std::size_t place)
  {
    NumberT number{};
    EXPECT_LE(place + sizeof number, bytes.size());
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
  }

  /** Each lies in its view, the view in the buffer, and begins where its numbers may. */
  void CheckAccessors() const
  {
    const std::map<int, std::size_t> sizes{ { 5123, 2 }, { 5125, 4 }, { 5126, 4 } };
    const std::map<std::string, std::size_t> shapes{ { "SCALAR", 1 }, { "VEC3", 3 },
      { "VEC4", 4 } };
    for (const Json& accessor : this->Document["accessors"])
    {
      const Json& view =
        this->Document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
      const std::size_t begin = view["byteOffset"], length = view["byteLength"];
      const std::size_t count = accessor["count"];
      const std::size_t element =
        sizes.at(accessor["componentType"]) * shapes.at(accessor["type"].get<std::string>());
      EXPECT_GT(count, 0u);
      EXPECT_EQ(begin % 4, 0u);
      EXPECT_EQ(element % 4, 0u);
      EXPECT_EQ(length, count * element);
      EXPECT_LE(begin + length, this->Buffer.size());
    }
  }
};

vtkNew<vtkPolyData> Ball()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(5.0, -3.0, 0.25);
  sphere->Update();
  vtkNew<vtkPolyData> ball;
  ball->DeepCopy(sphere->GetOutput());
  return ball;
}

// Promise: a .glb is as the specification says: chunks, accessors within their buffers, bounds of the
// positions, indices of points that exist, normals of length 1, colours with opacity, linear.
TEST_F(GlbFile, IsSound)
{
  const auto mesh = Ball();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < colors->GetNumberOfValues(); ++i)
  {
    colors->SetValue(i, static_cast<unsigned char>(i % 3 == 0 ? 255 : i % 3 == 1 ? 188 : 0));
  }
  mesh->GetPointData()->SetScalars(colors);
  // Two without a direction.
  mesh->GetPointData()->GetNormals()->SetTuple3(0, 0.0, 0.0, 0.0);
  mesh->GetPointData()->GetNormals()->SetTuple3(1, std::nan(""), 0.0, 0.0);
  WriteMesh(mesh, this->Path("mesh.glb"));
  const Glb glb(this->Path("mesh.glb"));
  const Json& primitive = glb.Primitive();
  const std::size_t positions = primitive["attributes"]["POSITION"];
  const auto points = static_cast<std::size_t>(mesh->GetNumberOfPoints());

  const auto coordinates = glb.NumbersOf<float>(positions);
  ASSERT_EQ(coordinates.size(), 3 * points);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    float lowest = coordinates[axis], highest = coordinates[axis];
    for (std::size_t i = 0; i < points; ++i)
    {
      // As they are: y is not made the height.
      ASSERT_EQ(coordinates[3 * i + axis],
        static_cast<float>(mesh->GetPoint(static_cast<vtkIdType>(i))[axis]));
      lowest = std::min(lowest, coordinates[3 * i + axis]);
      highest = std::max(highest, coordinates[3 * i + axis]);
    }
    EXPECT_EQ(glb.Document["accessors"][positions]["min"][axis].get<float>(), lowest);
    EXPECT_EQ(glb.Document["accessors"][positions]["max"][axis].get<float>(), highest);
  }

  const auto normals = glb.NumbersOf<float>(primitive["attributes"]["NORMAL"]);
  ASSERT_EQ(normals.size(), 3 * points);
  for (std::size_t i = 0; i < points; ++i)
  {
    EXPECT_NEAR(std::hypot(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), 1.0, 1e-5);
  }
  const auto shades = glb.NumbersOf<std::uint16_t>(primitive["attributes"]["COLOR_0"]);
  ASSERT_EQ(shades.size(), 4 * points);
  // Of the sRGB value 188 it is half the light.
  EXPECT_EQ(shades[0], 65535);
  EXPECT_NEAR(shades[1] / 65535.0, 0.5, 0.01);
  EXPECT_EQ(shades[2], 0);
  EXPECT_EQ(shades[3], 65535);

  EXPECT_EQ(primitive["mode"], 4);
  const auto indices = glb.NumbersOf<std::uint32_t>(primitive["indices"]);
  EXPECT_EQ(indices.size(), 3 * static_cast<std::size_t>(mesh->GetNumberOfPolys()));
  EXPECT_LT(*std::max_element(indices.begin(), indices.end()), points);
  EXPECT_EQ(glb.Document["materials"][0]["doubleSided"], true);
  EXPECT_FALSE(glb.Document["asset"].contains("extras"));
}

// Promise: points without triangles are points, and a shift is told.
TEST_F(GlbFile, PointsAndShifts)
{
  vtkNew<vtkPolyData> points;
  points->SetPoints(Ball()->GetPoints());
  WriteMesh(points, this->Path("points.glb"), MeshShift{ false, { 5.0, 0.5, 0.0 } });
  const Glb glb(this->Path("points.glb"));
  EXPECT_EQ(glb.Primitive()["mode"], 0);
  EXPECT_FALSE(glb.Primitive().contains("indices"));
  EXPECT_EQ(glb.Document["asset"]["extras"]["shift"], Json({ 5.0, 0.5, 0.0 }));
}
}
