// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshWriter.h"

#include "base/AtomicFile.h"
#include "cloud/CoordinateRange.h"
#include "file/WriteMesh.h"
#include "vtkMeshFile.h"
#include "vtkShift.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkNeuralMeshWriter);

namespace
{
/** Of so many points, or a few more, spread over all of them. */
constexpr vtkIdType PointsToLookAt = 100000;

neuralmesh::CoordinateRange RangeOf(vtkPointSet* data)
{
  const vtkIdType count = data->GetNumberOfPoints();
  const vtkIdType step = 1 + count / PointsToLookAt;
  std::vector<Eigen::Vector3d> points;
  for (vtkIdType i = 0; i < count; i += step)
  {
    data->GetPoint(i, points.emplace_back().data());
  }
  return neuralmesh::CoordinateRange(points);
}

/** Whether there are digits in a mesh that floats would lose. */
bool NeedsDoubles(vtkPolyData* mesh)
{
  return mesh->GetPoints()->GetDataType() == VTK_DOUBLE &&
    !RangeOf(mesh).fitsFloats(
      static_cast<std::size_t>(mesh->GetNumberOfPoints()), Eigen::Vector3d::Zero());
}

/** Throws std::runtime_error where the format cannot hold a mesh with so many vertices there. */
void RequireDigits(
  vtkPointSet* points, vtkIdType vertices, const Eigen::Vector3d& shift, const std::string& path)
{
  if (vtkMeshFile::HasOnlyFloats(vtkMeshFile::Extension(path)))
  {
    neuralmesh::requireDigits(path, RangeOf(points), static_cast<std::size_t>(vertices), shift);
  }
}
}

vtkNeuralMeshWriter::vtkNeuralMeshWriter() = default;

vtkNeuralMeshWriter::~vtkNeuralMeshWriter() = default;

void vtkNeuralMeshWriter::SetFileName(const char* name)
{
  const std::string wanted = name ? name : "";
  if (this->FileName != wanted)
  {
    this->FileName = wanted;
    this->Modified();
  }
}

bool vtkNeuralMeshWriter::CanWriteFile(const char* name)
{
  return name && vtkMeshFile::IsKnown(vtkMeshFile::Extension(name));
}

bool vtkNeuralMeshWriter::CheckCoordinates(vtkPointSet* points, vtkIdType numberOfVertices)
{
  if (this->AutomaticShift || !points)
  {
    return true;
  }
  try
  {
    RequireDigits(points, numberOfVertices, Eigen::Vector3d(this->Shift), this->FileName);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  return true;
}

void vtkNeuralMeshWriter::UndoShift(const char* fileName, vtkPointSet* points)
{
  const Eigen::Vector3d noted = vtkMeshFile::NotedShift(fileName ? fileName : "");
  if (!noted.isZero(0.0))
  {
    vtkShift::Store(points, noted);
  }
  vtkShift::Undo(points);
}

void vtkNeuralMeshWriter::WriteMesh(vtkPolyData* mesh)
{
  Eigen::Map<Eigen::Vector3d>(this->StoredShift).setZero();
  if (this->FileName.empty())
  {
    throw std::runtime_error("There is no FileName.");
  }
  if (!vtkNeuralMeshWriter::CanWriteFile(this->FileName.c_str()))
  {
    throw std::runtime_error(
      this->FileName + ": unknown extension; writable are .vtp .ply .obj .stl .glb .off .vtk");
  }
  const vtkIdType vertices = mesh ? mesh->GetNumberOfPoints() : 0;
  if (vertices == 0)
  {
    throw std::runtime_error("There are no points to write.");
  }
  const Eigen::Vector3d shift = this->AutomaticShift
    ? mesh->GetPoints()->GetDataType() == VTK_DOUBLE
      ? RangeOf(mesh).roundShift(static_cast<std::size_t>(vertices))
      : Eigen::Vector3d(Eigen::Vector3d::Zero())
    : Eigen::Vector3d(this->Shift);
  if (!shift.allFinite())
  {
    throw std::runtime_error("The shift is not finite.");
  }
  const auto shifted = vtkShift::Apply(mesh, shift);
  const bool hasDoubles = NeedsDoubles(shifted);
  if (hasDoubles)
  {
    RequireDigits(shifted, vertices, Eigen::Vector3d::Zero(), this->FileName);
  }
  neuralmesh::writeAtomicFile(this->FileName,
    [&](const std::string& temporary) { vtkMeshFile::Write(shifted, temporary, hasDoubles); });
  Eigen::Map<Eigen::Vector3d>(this->StoredShift) = vtkShift::Stored(shifted);
}

void vtkNeuralMeshWriter::WriteData()
{
  try
  {
    this->WriteMesh(vtkPolyData::SafeDownCast(this->GetInput()));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
}

int vtkNeuralMeshWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

void vtkNeuralMeshWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
  os << indent << "AutomaticShift: " << this->AutomaticShift << "\n";
  for (const auto& [name, shift] :
    { std::pair{ "Shift", this->Shift }, std::pair{ "StoredShift", this->StoredShift } })
  {
    os << indent << name << ": (" << shift[0] << ", " << shift[1] << ", " << shift[2] << ")\n";
  }
}
