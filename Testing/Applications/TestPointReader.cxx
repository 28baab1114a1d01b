// SPDX-License-Identifier: BSD-3-Clause
#include "FileTest.h"
#include "PointReader.h"

#include "vtkOBJWriter.h"
#include "vtkPLYWriter.h"
#include "vtkPoints.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkPolyDataWriter.h"
#include "vtkSTLWriter.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_THROW(ReadPoints(this->WriteText("a.vtp", "this is no XML")), std::runtime_error);
}
}
