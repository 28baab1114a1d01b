// SPDX-License-Identifier: BSD-3-Clause
// Promise: a mesh whose coordinates floats cannot hold keeps its digits in every format that has them,
// and is refused in the one that has not, before or after it is there; others are written as by VTK. A
// shift is taken off, noted in the file, and undone. What cannot be written leaves what was there.
#include "FilterTesting.h"

#include "vtkNeuralMeshPLYReader.h"
#include "vtkNeuralMeshWriter.h"

#include "vtkDoubleArray.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
const std::filesystem::path Folder =
  std::filesystem::temp_directory_path() / "neuralmesh-TestNeuralMeshWriter";

std::string PathOf(const std::string& name) { return (Folder / name).string(); }

std::string BytesOf(const std::string& path)
{
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

/** A tetrahedron of edges of about 1, with colours. */
vtkNew<vtkPolyData> Tetrahedron(std::array<double, 3> place, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->InsertNextPoint(place[0], place[1], place[2]);
  points->InsertNextPoint(place[0] + 1.0, place[1], place[2]);
  points->InsertNextPoint(place[0], place[1] + 0.1, place[2]);
  points->InsertNextPoint(place[0], place[1], place[2] + 0.7);
  vtkNew<vtkCellArray> cells;
  for (const auto& corners :
    { std::array<vtkIdType, 3>{ 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } })
  {
    cells->InsertNextCell(3, corners.data());
  }
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  for (const unsigned char shade : { 1, 2, 3, 4 })
  {
    const std::array<unsigned char, 3> color{ shade, 20, 30 };
    colors->InsertNextTypedTuple(color.data());
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  mesh->GetPointData()->SetScalars(colors);
  return mesh;
}

constexpr std::array<double, 3> Utm{ 500000.3, 5400000.7, 100.0 };

/** Whether it is written without an error. */
bool Write(vtkNeuralMeshWriter* writer, vtkPolyData* mesh, const std::string& path)
{
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(writer);
  writer->SetFileName(path.c_str());
  writer->SetInputData(mesh);
  const bool written = writer->Write() == 1;
  writer->RemoveObserver(messages);
  return written && messages->Errors == 0;
}

bool Write(vtkPolyData* mesh, const std::string& path)
{
  return Write(vtkNew<vtkNeuralMeshWriter>(), mesh, path);
}

vtkNew<vtkPolyData> ReadPLY(const std::string& path)
{
  vtkNew<vtkNeuralMeshPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkNew<vtkPolyData> output;
  output->DeepCopy(reader->GetOutput());
  return output;
}

/** Points where floats are dense, and float points wherever they lie: the bytes of vtkPLYWriter. */
int CheckFloats()
{
  for (const auto& mesh :
    { Tetrahedron({ 1.0, 2.0, 3.0 }), Tetrahedron(Utm, VTK_FLOAT), Tetrahedron({ 0.0, 0.0, 0.0 }) })
  {
    CHECK(Write(mesh, PathOf("ours.ply")));
    vtkNew<vtkPLYWriter> writer;
    writer->SetFileName(PathOf("vtks.ply").c_str());
    writer->SetArrayName("RGB");
    writer->SetInputData(mesh);
    writer->Write();
    CHECK(BytesOf(PathOf("ours.ply")) == BytesOf(PathOf("vtks.ply")));
    CHECK(Write(mesh, PathOf("mesh.stl")));
  }
  return EXIT_SUCCESS;
}

int CheckDigits()
{
  const auto mesh = Tetrahedron(Utm);
  CHECK(Write(mesh, PathOf("mesh.ply")));
  const auto read = ReadPLY(PathOf("mesh.ply"));
  CHECK(FilterTesting::SameBytes(read->GetPoints()->GetData(), mesh->GetPoints()->GetData()));
  CHECK(FilterTesting::SameBytes(
    read->GetPointData()->GetScalars(), mesh->GetPointData()->GetScalars()));
  CHECK(read->GetNumberOfPolys() == 4);
  CHECK(Write(mesh, PathOf("mesh.obj")));
  CHECK(BytesOf(PathOf("mesh.obj")).find("v 500001.3 5400000.7 100\n") != std::string::npos);

  std::ofstream(PathOf("mesh.stl")) << "what was there";
  CHECK(!Write(mesh, PathOf("mesh.stl")));
  CHECK(BytesOf(PathOf("mesh.stl")) == "what was there");
  vtkNew<vtkNeuralMeshWriter> writer;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(writer);
  writer->SetFileName(PathOf("mesh.stl").c_str());
  CHECK(!writer->CheckCoordinates(mesh, 4) && messages->Errors == 1);
  for (const char* words : { "mesh.stl", "0.5 apart", ".ply", "--shift" })
  {
    CHECK(messages->AllText.find(words) != std::string::npos);
  }
  // What came as floats does not make the mesh of them fit floats.
  vtkNew<vtkPolyData> floats;
  floats->SetPoints(
    FilterTesting::SpherePoints(1000, 50.0, { 500000.0, 5400000.0, 0.0 }, VTK_FLOAT));
  CHECK(!writer->CheckCoordinates(floats, 20000) && messages->Errors == 2);
  writer->AutomaticShiftOn();
  CHECK(writer->CheckCoordinates(mesh, 4));
  writer->AutomaticShiftOff();
  writer->SetShift(500000.0, 5400000.0, 0.0);
  CHECK(writer->CheckCoordinates(mesh, 4));
  CHECK(messages->Errors == 2);
  return EXIT_SUCCESS;
}

/** Of each coordinate, to what a float of a shifted one can tell. */
bool IsNear(vtkPolyData* mesh, vtkPolyData* other)
{
  for (vtkIdType i = 0; i < 4; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(std::abs(mesh->GetPoint(i)[axis] - other->GetPoint(i)[axis]) < 1e-7))
      {
        return false;
      }
    }
  }
  return true;
}

int CheckShift()
{
  const auto mesh = Tetrahedron(Utm);
  vtkNew<vtkNeuralMeshWriter> writer;
  writer->AutomaticShiftOn();
  CHECK(Write(writer, mesh, PathOf("mesh.ply")));
  CHECK(writer->GetStoredShift()[0] == 500000.0 && writer->GetStoredShift()[1] == 5400000.0);
  CHECK(writer->GetStoredShift()[2] == 100.0);
  const std::string ply = BytesOf(PathOf("mesh.ply"));
  CHECK(ply.find("\ncomment shift 500000 5400000 100\n") != std::string::npos);
  CHECK(ply.find("property float x\n") != std::string::npos);
  CHECK(IsNear(ReadPLY(PathOf("mesh.ply")), mesh));

  CHECK(Write(writer, mesh, PathOf("mesh.vtp")));
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(PathOf("mesh.vtp").c_str());
  reader->Update();
  CHECK(std::abs(reader->GetOutput()->GetPoint(0)[1] - 0.7) < 1e-9);
  // Once more: both shifts are one, and are undone as one.
  writer->AutomaticShiftOff();
  writer->SetShift(0.25, 0.0, 0.0);
  CHECK(Write(writer, reader->GetOutput(), PathOf("mesh.vtp")));
  CHECK(writer->GetStoredShift()[0] == 500000.25 && writer->GetStoredShift()[1] == 5400000.0);
  reader->SetFileName(PathOf("mesh.vtp").c_str());
  reader->Modified();
  reader->Update();
  vtkNeuralMeshWriter::UndoShift(PathOf("mesh.vtp").c_str(), reader->GetOutput());
  CHECK(IsNear(reader->GetOutput(), mesh));
  CHECK(!reader->GetOutput()->GetFieldData()->HasArray("Shift"));

  for (const char* name : { "mesh.obj", "mesh.stl" })
  {
    writer->SetShift(500000.0, 5400000.0, 0.0);
    CHECK(Write(writer, mesh, PathOf(name)));
    CHECK(BytesOf(PathOf(name)).find("shift 500000 5400000 0") != std::string::npos);
    vtkNew<vtkPolyData> moved;
    moved->DeepCopy(mesh);
    vtkNeuralMeshWriter::UndoShift(PathOf(name).c_str(), moved);
    CHECK(moved->GetPoint(0)[0] == Utm[0] + 500000.0);
  }
  // Nothing to gain, so nothing is shifted.
  writer->AutomaticShiftOn();
  CHECK(Write(writer, Tetrahedron({ 1.0, 2.0, 3.0 }), PathOf("near.ply")));
  CHECK(writer->GetStoredShift()[0] == 0.0);
  CHECK(BytesOf(PathOf("near.ply")).find("shift") == std::string::npos);
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  const auto mesh = Tetrahedron({ 0.0, 0.0, 0.0 });
  vtkNew<vtkPolyData> empty;
  CHECK(!Write(empty, PathOf("empty.ply")));
  CHECK(!Write(mesh, ""));
  CHECK(!Write(mesh, PathOf("mesh.doc")));
  CHECK(!Write(mesh, PathOf("nowhere/mesh.ply")));
  vtkNew<vtkNeuralMeshWriter> writer;
  writer->SetShift(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  CHECK(!Write(writer, mesh, PathOf("nan.ply")));
  writer->SetShift(1e100, 0.0, 0.0);
  CHECK(!Write(writer, mesh, PathOf("long.stl")));
  CHECK(std::filesystem::is_empty(Folder));
  CHECK(vtkNeuralMeshWriter::CanWriteFile("a.PLY") && !vtkNeuralMeshWriter::CanWriteFile("a.vtu"));
  CHECK(!vtkNeuralMeshWriter::CanWriteFile(nullptr));
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshWriter(int, char*[])
{
  for (const auto check : { CheckFloats, CheckDigits, CheckShift, CheckErrors })
  {
    std::filesystem::remove_all(Folder);
    std::filesystem::create_directories(Folder);
    const int status = check();
    std::filesystem::remove_all(Folder);
    if (status != EXIT_SUCCESS)
    {
      return status;
    }
  }
  return EXIT_SUCCESS;
}
