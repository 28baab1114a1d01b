// SPDX-License-Identifier: BSD-3-Clause
#include "vtkShift.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace
{
constexpr const char* ArrayName = "Shift";

/** Of the points plus a vector. */
vtkNew<vtkPoints> Moved(vtkPointSet* data, const Eigen::Vector3d& vector, int type)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->SetNumberOfPoints(data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    Eigen::Vector3d point;
    data->GetPoint(i, point.data());
    point += vector;
    points->SetPoint(i, point.data());
  }
  return points;
}
}

Eigen::Vector3d vtkShift::Stored(vtkPointSet* points)
{
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  auto* stored = vtkDoubleArray::SafeDownCast(points->GetFieldData()->GetArray(ArrayName));
  if (stored && stored->GetNumberOfComponents() == 3 && stored->GetNumberOfTuples() == 1)
  {
    stored->GetTypedTuple(0, shift.data());
  }
  return shift.allFinite() ? shift : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

void vtkShift::Store(vtkPointSet* points, const Eigen::Vector3d& shift)
{
  // Others may have the same field data.
  vtkNew<vtkFieldData> fields;
  fields->ShallowCopy(points->GetFieldData());
  fields->RemoveArray(ArrayName);
  if (!shift.isZero(0.0))
  {
    vtkNew<vtkDoubleArray> stored;
    stored->SetName(ArrayName);
    stored->SetNumberOfComponents(3);
    stored->InsertNextTypedTuple(shift.data());
    fields->AddArray(stored);
  }
  points->SetFieldData(fields);
}

vtkSmartPointer<vtkPolyData> vtkShift::Apply(vtkPolyData* mesh, const Eigen::Vector3d& shift)
{
  if (shift.isZero(0.0) || !mesh->GetPoints())
  {
    return mesh;
  }
  auto shifted = vtkSmartPointer<vtkPolyData>::New();
  shifted->ShallowCopy(mesh);
  shifted->SetPoints(Moved(mesh, -shift, mesh->GetPoints()->GetDataType()));
  Store(shifted, Stored(mesh) + shift);
  return shifted;
}

void vtkShift::Undo(vtkPointSet* points)
{
  const Eigen::Vector3d shift = Stored(points);
  if (!shift.isZero(0.0) && points->GetPoints())
  {
    points->SetPoints(Moved(points, shift, VTK_DOUBLE));
    Store(points, Eigen::Vector3d::Zero());
  }
}
