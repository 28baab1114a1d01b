// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshInformation.h"

#include "mesh/SurfaceReport.h"
#include "vtkMeshArrays.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshInformation);

namespace
{
void AddCount(vtkPolyData* mesh, const char* name, std::size_t count)
{
  vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(mesh, name, static_cast<vtkIdType>(count));
}

void AddNumber(vtkPolyData* mesh, const char* name, double number)
{
  vtkMeshArrays::AddFieldValue<vtkDoubleArray>(mesh, name, number);
}

void AddAnswer(vtkPolyData* mesh, const char* name, bool answer)
{
  vtkMeshArrays::AddFieldValue<vtkUnsignedCharArray>(
    mesh, name, static_cast<unsigned char>(answer));
}

void AddValences(vtkPolyData* mesh, const neuralmesh::SurfaceReport& report)
{
  vtkNew<vtkIdTypeArray> valences;
  valences->SetName("Valences");
  valences->SetNumberOfComponents(2);
  for (const auto& [valence, vertices] : report.valences)
  {
    valences->InsertNextValue(static_cast<vtkIdType>(valence));
    valences->InsertNextValue(static_cast<vtkIdType>(vertices));
  }
  mesh->GetFieldData()->AddArray(valences);
}

void AddReport(vtkPolyData* mesh, const neuralmesh::SurfaceReport& report)
{
  AddCount(mesh, "Vertices", report.vertices);
  AddCount(mesh, "Triangles", report.triangles);
  AddNumber(mesh, "RegularRatio", report.regularRatio);
  AddValences(mesh, report);
  AddNumber(mesh, "TriangleQuality", report.meanQuality);
  AddAnswer(mesh, "Closed", report.isClosed());
  AddAnswer(mesh, "EdgeManifold", report.isEdgeManifold());
  AddAnswer(mesh, "VertexManifold", report.isVertexManifold());
  AddAnswer(mesh, "Oriented", report.isOriented());
  AddCount(mesh, "Components", report.components);
  // The input may bring those of an earlier report along.
  mesh->GetFieldData()->RemoveArray("Genus");
  mesh->GetFieldData()->RemoveArray("Volume");
  if (report.genus)
  {
    vtkMeshArrays::AddFieldValue<vtkIdTypeArray>(mesh, "Genus", *report.genus);
  }
  AddCount(mesh, "BoundaryLoops", report.boundaryLoops);
  AddCount(mesh, "BoundaryEdges", report.boundaryEdges);
  AddCount(mesh, "FoldedEdges", report.foldedEdges);
  AddCount(mesh, "NonManifoldEdges", report.nonManifoldEdges);
  AddCount(mesh, "NonManifoldVertices", report.nonManifoldVertices);
  AddCount(mesh, "InconsistentEdges", report.inconsistentEdges);
  AddNumber(mesh, "SurfaceArea", report.area);
  if (report.volume)
  {
    AddNumber(mesh, "Volume", *report.volume);
  }
  AddNumber(mesh, "BoundingBoxDiagonal", report.diagonal);
  AddCount(mesh, "DegenerateTriangles", report.degenerateTriangles);
  AddCount(mesh, "UnusedPoints", report.unusedPoints);
  AddCount(mesh, "NonFinitePoints", report.nonFinitePoints);
}
}

vtkNeuralMeshInformation::vtkNeuralMeshInformation()
{
  this->SetProgressText("Neural Mesh Information");
}

vtkNeuralMeshInformation::~vtkNeuralMeshInformation() = default;

int vtkNeuralMeshInformation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  std::optional<neuralmesh::SurfaceReport> report;
  try
  {
    report = neuralmesh::reportSurface(vtkTriangleMeshCollector::Collect(input));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  output->ShallowCopy(input);
  AddReport(output, *report);
  return 1;
}

void vtkNeuralMeshInformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
