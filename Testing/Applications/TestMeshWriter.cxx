// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"
#include "PointReader.h"

#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

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
  for (const char* name : { "mesh.vtp", "mesh.ply", "mesh.obj", "mesh.stl" })
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

// Promise: an unknown extension is refused before anything is done.
TEST(MeshWriter, RefusesUnknownExtensions)
{
  EXPECT_THROW(RequireWritableExtension("mesh.doc"), std::runtime_error);
  EXPECT_THROW(RequireWritableExtension("mesh"), std::runtime_error);
  EXPECT_NO_THROW(RequireWritableExtension("mesh.STL"));
}
}
