// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshExplanation.h"

#include "base/ThreadPool.h"
#include "cloud/PointCloud.h"
#include "run/ExplanationByMesh.h"
#include "vtkExplainedPoints.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointCloudCollector.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshExplanation);

vtkNeuralMeshExplanation::vtkNeuralMeshExplanation()
{
  this->SetNumberOfInputPorts(2);
  this->SetProgressText("Neural Mesh Explanation");
}

vtkNeuralMeshExplanation::~vtkNeuralMeshExplanation() = default;

void vtkNeuralMeshExplanation::SetMeshConnection(vtkAlgorithmOutput* port)
{
  this->SetInputConnection(1, port);
}

void vtkNeuralMeshExplanation::SetMeshData(vtkPolyData* mesh) { this->SetInputData(1, mesh); }

vtkPolyData* vtkNeuralMeshExplanation::GetMesh()
{
  return this->GetNumberOfInputConnections(1) > 0
    ? vtkPolyData::SafeDownCast(this->GetInputDataObject(1, 0))
    : nullptr;
}

int vtkNeuralMeshExplanation::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkNeuralMeshExplanation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPointCloudCollector collector;
  collector.Collect(vtkDataObject::GetData(inputVector[0]));
  if (collector.GetPoints().empty())
  {
    return 1;
  }
  const neuralmesh::PointCloud cloud(collector.GetPoints(), {}, true);
  if (!cloud.hasExtent())
  {
    vtkErrorMacro(<< cloud.whyNoExtent());
    return 0;
  }
  neuralmesh::TriangleMesh mesh;
  try
  {
    mesh = vtkTriangleMeshCollector::Collect(vtkPolyData::GetData(inputVector[1]));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< "The mesh cannot be used: " << error.what() << ".");
    return 0;
  }
  neuralmesh::ExplanationRules rules;
  rules.leastPiece = this->SmallestPiece;
  vtkNeuralMeshProgress progress(this);
  std::optional<neuralmesh::Explanation> explanation;
  try
  {
    explanation = neuralmesh::explainByMesh(cloud, mesh, rules, progress.GetPart(0.0, 1.0),
      neuralmesh::ThreadPool(vtkNeuralMeshThreads(0)));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  if (explanation)
  {
    vtkExplainedPoints::Fill(collector, cloud, *explanation, vtkPolyData::GetData(outputVector));
  }
  return 1;
}

void vtkNeuralMeshExplanation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmallestPiece: " << this->SmallestPiece << "\n";
}
