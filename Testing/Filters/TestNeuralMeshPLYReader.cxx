// SPDX-License-Identifier: BSD-3-Clause
// Promise: a .ply of floats comes out as of vtkPLYReader, to the last bit; doubles keep their digits,
// with all that goes with them; and a file that is no whole .ply is an error with an empty output.
#include "FilterTesting.h"

#include "vtkNeuralMeshPLYReader.h"

#include "vtkExecutive.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"

#include <filesystem>
#include <fstream>

namespace
{
const std::string Path =
  (std::filesystem::temp_directory_path() / "neuralmesh-TestNeuralMeshPLYReader.ply").string();

void Write(const std::string& bytes) { std::ofstream(Path, std::ios::binary) << bytes; }

/** Three points far from the origin with normals and colours, and a triangle, as text. */
std::string Triangle(const std::string& type, const std::string& comment = "")
{
  std::string properties;
  for (const char* name : { "x", "y", "z" })
  {
    properties += "property " + type + " " + name + "\n";
  }
  for (const char* name : { "nx", "ny", "nz" })
  {
    properties += std::string("property float ") + name + "\n";
  }
  for (const char* name : { "red", "green", "blue" })
  {
    properties += std::string("property uchar ") + name + "\n";
  }
  return "ply\nformat ascii 1.0\n" + comment + "element vertex 3\n" + properties +
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "500000.0625 5400000.125 100.1 0 0 1 1 2 3\n500001.0625 5400000.125 100.1 0 0 1 4 5 6\n"
    "500000.0625 5400001.125 100.1 0 0 1 7 8 9\n3 2 0 1\n";
}

template <typename ReaderT>
vtkNew<vtkPolyData> Read()
{
  vtkNew<ReaderT> reader;
  reader->SetFileName(Path.c_str());
  reader->Update();
  vtkNew<vtkPolyData> output;
  output->DeepCopy(reader->GetOutput());
  return output;
}

int CheckFloats()
{
  Write(Triangle("float"));
  const auto ours = Read<vtkNeuralMeshPLYReader>(), vtks = Read<vtkPLYReader>();
  CHECK(FilterTesting::SameBytes(ours->GetPoints()->GetData(), vtks->GetPoints()->GetData()));
  CHECK(ours->GetPointData()->GetNumberOfArrays() == 2);
  for (int i = 0; i < 2; ++i)
  {
    vtkDataArray* array = vtks->GetPointData()->GetArray(i);
    CHECK(FilterTesting::SameBytes(ours->GetPointData()->GetArray(array->GetName()), array));
  }
  CHECK(FilterTesting::SameBytes(
    ours->GetPolys()->GetConnectivityArray(), vtks->GetPolys()->GetConnectivityArray()));
  return EXIT_SUCCESS;
}

/**
 * Keeps the bytes of vtkPLYReader, whichever reader takes the file. That such a file is read as a whole
 * is for TestPlyContents to keep.
 */
int CheckFloatsAlone()
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\n"
                      "property float y\nproperty float z\nend_header\n";
  for (const float number : { 0.1f, -2e30f, 0.f, 1e-40f, 500000.0625f, 5.f })
  {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
  }
  Write(bytes);
  const auto ours = Read<vtkNeuralMeshPLYReader>(), vtks = Read<vtkPLYReader>();
  CHECK(ours->GetNumberOfPoints() == 2);
  CHECK(FilterTesting::SameBytes(ours->GetPoints()->GetData(), vtks->GetPoints()->GetData()));
  CHECK(ours->GetPointData()->GetNumberOfArrays() == 0 && ours->GetNumberOfCells() == 0);
  return EXIT_SUCCESS;
}

int CheckDoubles()
{
  Write(Triangle("double"));
  const auto mesh = Read<vtkNeuralMeshPLYReader>();
  CHECK(mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(mesh->GetPoint(1)[0] == 500001.0625 && mesh->GetPoint(2)[1] == 5400001.125);
  CHECK(mesh->GetPoint(2)[2] == 100.1);
  CHECK(mesh->GetPointData()->GetNormals()->GetComponent(2, 2) == 1.0);
  CHECK(mesh->GetPointData()->GetScalars()->GetComponent(2, 1) == 8.0);
  vtkNew<vtkIdList> corners;
  mesh->GetPolys()->GetCellAtId(0, corners);
  CHECK(corners->GetNumberOfIds() == 3 && corners->GetId(0) == 2);
  return EXIT_SUCCESS;
}

int CheckShift()
{
  Write(Triangle("float", "comment shift 0.25 -5400000 0\n"));
  const auto mesh = Read<vtkNeuralMeshPLYReader>();
  CHECK(mesh->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(mesh->GetPoint(0)[0] == 500000.3125 && mesh->GetPoint(0)[1] == 0.0);
  CHECK(!mesh->GetFieldData()->HasArray("Shift"));
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  const std::string whole = Triangle("double");
  for (const auto& [bytes, words] :
    { std::pair<std::string, const char*>{ whole.substr(0, whole.size() - 8), "last face" },
      { whole.substr(0, whole.size() - 60), "last vertex" }, { whole.substr(0, 100), "not end" },
      { "no .ply", "no .ply" } })
  {
    Write(bytes);
    vtkNew<vtkNeuralMeshPLYReader> reader;
    reader->SetFileName(Path.c_str());
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(reader);
    messages->Observe(reader->GetExecutive());
    reader->Update();
    CHECK(messages->AllText.find(words) != std::string::npos);
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  }
  std::filesystem::remove(Path);
  for (const char* name : { Path.c_str(), "", static_cast<const char*>(nullptr) })
  {
    vtkNew<vtkNeuralMeshPLYReader> reader;
    reader->SetFileName(name);
    vtkNew<FilterTesting::MessageCounter> messages;
    messages->Observe(reader);
    messages->Observe(reader->GetExecutive());
    reader->Update();
    CHECK(messages->Errors > 0);
  }
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshPLYReader(int, char*[])
{
  for (const auto check : { CheckFloats, CheckFloatsAlone, CheckDoubles, CheckShift, CheckErrors })
  {
    if (check() != EXIT_SUCCESS)
    {
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
