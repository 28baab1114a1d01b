// SPDX-License-Identifier: BSD-3-Clause
#include "MeshReader.h"

#include "FileExtension.h"
#include "PointReader.h"

#include "vtkCleanPolyData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <set>
#include <stdexcept>

namespace
{
vtkSmartPointer<vtkPolyData> MergeEqualPoints(vtkPolyData* mesh)
{
  vtkNew<vtkCleanPolyData> clean;
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(0.0);
  // What degenerates is to be reported, not turned into lines.
  clean->ConvertLinesToPointsOff();
  clean->ConvertPolysToLinesOff();
  clean->ConvertStripsToPolysOff();
  clean->SetInputData(mesh);
  clean->Update();
  return clean->GetOutput();
}
}

vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path)
{
  static const std::set<std::string> extensions{ ".ply", ".vtp", ".vtk", ".obj", ".stl", ".off" };
  const std::string extension = FileExtension(path);
  if (extensions.count(extension) == 0)
  {
    throw std::runtime_error(
      path + ": no mesh is read from this extension; readable are .ply .vtp .vtk .obj .stl .off");
  }
  const auto data = ReadPoints(path);
  vtkSmartPointer<vtkPolyData> mesh = vtkPolyData::SafeDownCast(data);
  if (!mesh || mesh->GetNumberOfPolys() + mesh->GetNumberOfStrips() == 0)
  {
    throw std::runtime_error(path + ": there are no triangles in it");
  }
  if (extension == ".obj" && mesh->GetPointData()->GetNumberOfArrays() > 0)
  {
    mesh = MergeEqualPoints(mesh);
  }
  return mesh;
}
