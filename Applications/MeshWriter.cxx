// SPDX-License-Identifier: BSD-3-Clause
#include "MeshWriter.h"

#include "ErrorCollector.h"

#include "vtkNeuralMeshWriter.h"

#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>

namespace
{
void Prepare(vtkNeuralMeshWriter* writer, ErrorCollector* errors, const MeshShift& shift,
  const std::string& path)
{
  errors->Observe(writer);
  writer->SetFileName(path.c_str());
  writer->SetAutomaticShift(shift.IsAutomatic);
  writer->SetShift(shift.Vector.data());
}
}

bool IsWritable(const std::string& path) { return vtkNeuralMeshWriter::CanWriteFile(path.c_str()); }

void RequireWritableExtension(const std::string& path)
{
  if (!IsWritable(path))
  {
    throw std::runtime_error(
      path + ": unknown extension; writable are .vtp .ply .obj .stl .glb .off .vtk");
  }
}

void RequireWritableDigits(
  vtkPointSet* points, vtkIdType numberOfVertices, const MeshShift& shift, const std::string& path)
{
  vtkNew<vtkNeuralMeshWriter> writer;
  vtkNew<ErrorCollector> errors;
  Prepare(writer, errors, shift, path);
  if (!writer->CheckCoordinates(points, numberOfVertices))
  {
    throw std::runtime_error(errors->GetMessage());
  }
}

std::array<double, 3> WriteMesh(vtkPolyData* mesh, const std::string& path, const MeshShift& shift)
{
  vtkNew<vtkNeuralMeshWriter> writer;
  vtkNew<ErrorCollector> errors;
  Prepare(writer, errors, shift, path);
  writer->SetInputData(mesh);
  writer->Write();
  if (errors->HasError())
  {
    throw std::runtime_error(errors->GetMessage());
  }
  std::array<double, 3> stored{};
  writer->GetStoredShift(stored.data());
  return stored;
}
