// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkNeuralMeshComparison share.
#ifndef ComparisonTesting_h
#define ComparisonTesting_h

#include "vtkNeuralMeshComparison.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <cmath>
#include <utility>

namespace ComparisonTesting
{
inline constexpr int ToResult = vtkNeuralMeshComparison::REFERENCE_TO_RESULT;
inline constexpr int ToReference = vtkNeuralMeshComparison::RESULT_TO_REFERENCE;

inline bool IsNear(double value, double expected, double tolerance)
{
  return std::abs(value - expected) <= tolerance;
}

/** A rectangle in the plane z, as one quadrangle, in double precision. */
inline vtkNew<vtkPolyData> Rectangle(
  double width, double height, double z, std::array<double, 3> corner = { 0, 0, 0 })
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& [x, y] :
    { std::pair(0.0, 0.0), { width, 0.0 }, { width, height }, { 0.0, height } })
  {
    points->InsertNextPoint(corner[0] + x, corner[1] + y, corner[2] + z);
  }
  vtkNew<vtkPolyData> rectangle;
  rectangle->SetPoints(points);
  rectangle->AllocateExact(1, 4);
  const std::array<vtkIdType, 4> ids{ 0, 1, 2, 3 };
  rectangle->InsertNextCell(VTK_QUAD, 4, ids.data());
  return rectangle;
}

inline void Prepare(vtkNeuralMeshComparison* filter, vtkPolyData* reference, vtkPolyData* result)
{
  filter->SetReferenceData(reference);
  filter->SetInputData(result);
  filter->SetNumberOfSamples(5000);
}
}

#endif
