// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMeshArrays
 * @brief   what is known of a mesh, as VTK arrays
 *
 * Internal to the module.
 */

#ifndef vtkMeshArrays_h
#define vtkMeshArrays_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

class vtkMeshArrays
{
public:
  template <typename ArrayT, typename ValueT>
  static void AddFieldValue(vtkPolyData* output, const char* name, ValueT value)
  {
    vtkNew<ArrayT> array;
    array->SetName(name);
    array->InsertNextValue(value);
    output->GetFieldData()->AddArray(array);
  }

  static vtkNew<vtkFloatArray> MakeNormals(const std::vector<Eigen::Vector3d>& normals)
  {
    vtkNew<vtkFloatArray> array;
    array->SetName("Normals");
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(normals.size()));
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      array->SetTuple(static_cast<vtkIdType>(i), normals[i].data());
    }
    return array;
  }

  template <typename ArrayT = vtkDoubleArray, typename Number>
  static vtkNew<ArrayT> MakeNumbers(const char* name, const std::vector<Number>& numbers)
  {
    vtkNew<ArrayT> array;
    array->SetName(name);
    array->SetNumberOfValues(static_cast<vtkIdType>(numbers.size()));
    std::copy(numbers.begin(), numbers.end(), array->GetPointer(0));
    return array;
  }
};

#endif
