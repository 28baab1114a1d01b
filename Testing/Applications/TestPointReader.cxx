// SPDX-License-Identifier: BSD-3-Clause
#include "FileTest.h"
#include "MeshWriter.h"
#include "PointReader.h"

#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLWriter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVersionMacros.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace
{
using PointReader = FileTest;

/// A tetrahedron, as .stl has no points without triangles.
template <typename DataT>
vtkNew<DataT> Tetrahedron()
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  points->InsertNextPoint(0, 2, 0);
  points->InsertNextPoint(0, 0, 3);
  vtkNew<DataT> data;
  data->SetPoints(points);
  data->Allocate(4);
  for (const auto& triangle :
    { std::array<vtkIdType, 3>{ 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } })
  {
    data->InsertNextCell(VTK_TRIANGLE, 3, triangle.data());
  }
  return data;
}

// Promise: every format that is named is read, with all its points.
TEST_F(PointReader, ReadsEveryFormat)
{
  const auto polyData = Tetrahedron<vtkPolyData>();
  const auto grid = Tetrahedron<vtkUnstructuredGrid>();
  const std::vector<std::string> paths{
    this->WriteWith<vtkPLYWriter>("a.ply", polyData),
    this->WriteWith<vtkXMLPolyDataWriter>("a.vtp", polyData),
    this->WriteWith<vtkPolyDataWriter>("a.vtk", polyData),
    this->WriteWith<vtkXMLUnstructuredGridWriter>("a.vtu", grid),
    this->WriteWith<vtkOBJWriter>("a.obj", polyData),
    this->WriteWith<vtkSTLWriter>("a.stl", polyData),
    this->WriteText("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 2 0\n0 0 3\n3 0 2 1\n"),
    this->WriteText("a.pcd",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 4\nHEIGHT 1\nDATA ascii\n0 0 0\n1 0 0\n"
      "0 2 0\n0 0 3\n"),
    this->WriteText("a.pwn", "0 0 0 0 0 1\n1 0 0 0 0 1\n0 2 0 0 0 1\n0 0 3 0 0 1\n"),
    this->WriteText("a.ptx",
      "4\n1\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 9 1\n"
      "0 0 -9 1\n1 0 -9 1\n0 2 -9 1\n0 0 -6 1\n"),
    this->WriteText("a.xyz", "0 0 0\n1 0 0\n0 2 0\n0 0 3\n"),
    this->WriteText("a.pts", "4\n0 0 0 -12 1 2 3\n1 0 0 0 1 2 3\n0 2 0 0 1 2 3\n0 0 3 0 1 2 3\n"),
    this->WriteText("a.txt", "# a comment\n\n 0\t0\t0\n1;0;0\r\n0 2 0 // more\n0 0 3"),
    this->WriteText("a.csv", "X,Y,Z,Red\n0,0,0,255\n1,0,0,255\n0,+2,0,255\n0,0,3e0,255\n"),
  };
  for (const std::string& path : paths)
  {
    SCOPED_TRACE(path);
    const auto points = ReadPoints(path);
    ASSERT_TRUE(points);
    EXPECT_EQ(points->GetNumberOfPoints(), 4);
    double bounds[6];
    points->GetBounds(bounds);
    EXPECT_FLOAT_EQ(float(bounds[1]), 1.f);
    EXPECT_FLOAT_EQ(float(bounds[3]), 2.f);
    EXPECT_FLOAT_EQ(float(bounds[5]), 3.f);
  }
}

// Promise: nan and inf in text are points, for the filter to count and drop.
TEST_F(PointReader, KeepsPointsThatAreNotFinite)
{
  const auto points = ReadPoints(this->WriteText("a.xyz", "0 0 0\nnan 1 2\n1 inf 0\n"));
  ASSERT_EQ(points->GetNumberOfPoints(), 3);
  EXPECT_TRUE(std::isnan(points->GetPoint(1)[0]));
  EXPECT_TRUE(std::isinf(points->GetPoint(2)[1]));
}

// Promise: text keeps the precision of doubles.
TEST_F(PointReader, KeepsDoublePrecision)
{
  const auto points = ReadPoints(this->WriteText("a.xyz", "4500000.125 512345.0625 7.000001\n"));
  EXPECT_EQ(points->GetPoint(0)[0], 4500000.125);
  EXPECT_EQ(points->GetPoint(0)[2], 7.000001);
}

/** The message with which a file is refused; empty if it is not. */
std::string Refusal(const std::string& path)
{
  try
  {
    ReadPoints(path);
    return "";
  }
  catch (const std::runtime_error& error)
  {
    return error.what();
  }
}

// Promise: text that ends in the middle of a line, or before as many points as it counts, is refused;
// a last line without its end, or with a comment less, is none of that.
TEST_F(PointReader, RefusesTextThatEndsEarly)
{
  EXPECT_NE(
    Refusal(this->WriteText("a.csv", "x,y,z,red\n0,0,0,255\n1,0,0")).find("line 3: the file"),
    std::string::npos);
  EXPECT_NE(Refusal(this->WriteText("a.xyz", "0 0 0\n1 0")).find("line 2"), std::string::npos);
  EXPECT_NE(Refusal(this->WriteText("a.pts", "3\n0 0 0\n1 0 0\n")).find("before its last point"),
    std::string::npos);
  EXPECT_EQ(Refusal(this->WriteText("b.pts", "2\n0 0 0\n1 0 0")), "");
  EXPECT_EQ(Refusal(this->WriteText("b.csv", "0,0,0,1 // first\n1,0,0,2")), "");
  EXPECT_EQ(Refusal(this->WriteText("c.csv", "0,0,0,1\n1,0,0\n")), "");
}

// Promise: what VTK takes for a shorter file is refused: XML without its last tag, .stl of text without
// its last line.
TEST_F(PointReader, RefusesWhatLacksItsEnd)
{
  const auto mesh = Tetrahedron<vtkPolyData>();
  const auto grid = Tetrahedron<vtkUnstructuredGrid>();
  const auto raw = [](auto* writer) { writer->EncodeAppendedDataOff(); };
  for (const std::string& path : { this->WriteWith<vtkXMLPolyDataWriter>("a.vtp", mesh, raw),
         this->WriteWith<vtkXMLUnstructuredGridWriter>("a.vtu", grid, raw),
         this->WriteWith<vtkSTLWriter>("a.stl", mesh) })
  {
    SCOPED_TRACE(path);
    EXPECT_EQ(Refusal(path), "");
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 12);
    EXPECT_NE(Refusal(path).find("damaged: it ends before its "), std::string::npos)
      << Refusal(path);
  }
}

// Promise: coordinates of a .ply keep their digits, and a mesh written with a shift lies where it lay
// before, whatever the format.
TEST_F(PointReader, KeepsPlaces)
{
  const auto near = Tetrahedron<vtkPolyData>();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    const double* point = near->GetPoint(i);
    points->InsertNextPoint(500000.3 + point[0], 5400000.7 + point[1], point[2]);
  }
  const auto mesh = Tetrahedron<vtkPolyData>();
  mesh->SetPoints(points);
  for (const char* name : { "a.ply", "a.vtp", "a.obj", "a.stl", "a.off", "a.vtk" })
  {
    for (const bool isShifted : { false, true })
    {
      SCOPED_TRACE(std::string(name) + (isShifted ? " shifted" : ""));
      const std::string path = this->Path(name);
      if (!isShifted && std::string(name) == "a.stl")
      {
        EXPECT_THROW(WriteMesh(mesh, path), std::runtime_error);
        EXPECT_FALSE(std::filesystem::exists(path));
        continue;
      }
      const auto stored = WriteMesh(mesh, path, MeshShift{ isShifted, {} });
      EXPECT_EQ(stored[1], isShifted ? 5400000. : 0.);
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 2, 0)
      if (!isShifted && std::string(name) == "a.obj")
      {
        continue; // VTK reads floats.
      }
#endif
      double bounds[6];
      ReadPoints(path)->GetBounds(bounds);
      EXPECT_NEAR(bounds[0], 500000.3, isShifted ? 1e-7 : 0.);
      EXPECT_NEAR(bounds[3], 5400002.7, isShifted ? 1e-7 : 0.);
    }
  }
}

// Promise: what is no point is an error that names file and line.
TEST_F(PointReader, NamesTheLineThatIsNoPoint)
{
  const std::string path = this->WriteText("a.xyz", "0 0 0\n1 1\n");
  try
  {
    ReadPoints(path);
    FAIL() << "no error";
  }
  catch (const std::runtime_error& error)
  {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
  }
}

// Promise: files that do not exist, folders and unknown extensions are errors.
TEST_F(PointReader, RefusesWhatItCannotRead)
{
  EXPECT_THROW(ReadPoints(this->Path("missing.ply")), std::runtime_error);
  EXPECT_THROW(ReadPoints(this->Folder.string()), std::runtime_error);
  EXPECT_THROW(ReadPoints(this->WriteText("a.doc", "0 0 0\n")), std::runtime_error);
  EXPECT_NE(Refusal(this->WriteText("a.laz", "LASF")).find("python3 -c"), std::string::npos);
  EXPECT_THROW(ReadPoints(this->WriteText("a.vtp", "this is no XML")), std::runtime_error);
}
}
