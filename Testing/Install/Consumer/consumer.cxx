// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMesh.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cmath>
#include <iostream>

int main()
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 1000; ++i)
  {
    points->InsertNextPoint(std::cos(i), std::sin(i), std::sin(0.1 * i));
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  vtkNew<vtkNeuralMesh> mesh;
  mesh->SetInputData(cloud);
  mesh->SetNumberOfVertices(100);
  mesh->Update();
  std::cout << mesh->GetOutput()->GetNumberOfPoints() << " vertices" << std::endl;
}
