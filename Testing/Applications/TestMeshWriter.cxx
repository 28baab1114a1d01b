// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"
#include "PointReader.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace
{
// Promise: what is written is read back, and no other file stays behind.
TEST(MeshWriter, WritesWhatCanBeReadBack)
{
  const auto folder = std::filesystem::temp_directory_path() / "neuralmesh-MeshWriter";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  std::size_t files = 0;
  for (const char* name :
    { "mesh.vtp", "mesh.ply", "mesh.obj", "mesh.stl", "mesh.off", "mesh.vtk" })
  {
    SCOPED_TRACE(name);
    const std::string path = (folder / name).string();
    WriteMesh(sphere->GetOutput(), path);
    WriteMesh(sphere->GetOutput(), path); // over what is there
    ++files;
    EXPECT_EQ(ReadPoints(path)->GetNumberOfPoints(), sphere->GetOutput()->GetNumberOfPoints());
    EXPECT_EQ(ReadPoints(path)->GetNumberOfCells(), sphere->GetOutput()->GetNumberOfCells());
  }
  EXPECT_EQ(std::size_t(std::distance(std::filesystem::directory_iterator(folder), {})), files);
  std::filesystem::remove_all(folder);
}

// Promise: a .ply keeps colours if they are the active scalars, with or without opacity.
TEST(MeshWriter, KeepsColorsInPLY)
{
  const auto path = (std::filesystem::temp_directory_path() / "neuralmesh-colors.ply").string();
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  vtkPolyData* mesh = sphere->GetOutput();
  for (const int components : { 3, 4 })
  {
    SCOPED_TRACE(components);
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("Paint");
    colors->SetNumberOfComponents(components);
    colors->SetNumberOfTuples(mesh->GetNumberOfPoints());
    for (vtkIdType i = 0; i < colors->GetNumberOfValues(); ++i)
    {
      colors->SetValue(i, static_cast<unsigned char>(i % 251));
    }
    mesh->GetPointData()->SetScalars(colors);
    WriteMesh(mesh, path);
    const auto read = ReadPoints(path);
    auto* scalars = vtkUnsignedCharArray::SafeDownCast(read->GetPointData()->GetScalars());
    ASSERT_NE(scalars, nullptr);
    ASSERT_EQ(scalars->GetNumberOfValues(), colors->GetNumberOfValues());
    for (vtkIdType i = 0; i < colors->GetNumberOfValues(); ++i)
    {
      ASSERT_EQ(scalars->GetValue(i), colors->GetValue(i));
    }
  }
  // Only colours can be kept so.
  vtkNew<vtkFloatArray> heights;
  heights->SetName("Height");
  heights->SetNumberOfTuples(mesh->GetNumberOfPoints());
  heights->Fill(1.0);
  mesh->GetPointData()->SetScalars(heights);
  WriteMesh(mesh, path);
  EXPECT_EQ(ReadPoints(path)->GetPointData()->GetScalars(), nullptr);
  std::filesystem::remove(path);
}

// Promise: an unknown extension is refused before anything is done.
TEST(MeshWriter, RefusesUnknownExtensions)
{
  EXPECT_THROW(RequireWritableExtension("mesh.doc"), std::runtime_error);
  EXPECT_THROW(RequireWritableExtension("mesh"), std::runtime_error);
  EXPECT_NO_THROW(RequireWritableExtension("mesh.STL"));
}
}
