// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshScan.h"

#include "cloud/CloudGenerator.h"
#include "mesh/MeasuredSurface.h"
#include "vtkNeuralMeshRun.h"
#include "vtkTriangleMeshCollector.h"

#include "vtkCellArray.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkNeuralMeshScan);

namespace
{
/// A cell with all points, if there are any.
vtkNew<vtkCellArray> MakeCell(vtkIdType points)
{
  vtkNew<vtkCellArray> cells;
  if (points > 0)
  {
    cells->InsertNextCell(static_cast<int>(points));
  }
  for (vtkIdType i = 0; i < points; ++i)
  {
    cells->InsertCellPoint(i);
  }
  return cells;
}
}

vtkNeuralMeshScan::vtkNeuralMeshScan() { this->SetProgressText("Neural Mesh Scan"); }

vtkNeuralMeshScan::~vtkNeuralMeshScan() = default;

int vtkNeuralMeshScan::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (input->GetNumberOfPoints() == 0 && input->GetNumberOfCells() == 0)
  {
    return 1;
  }
  const Eigen::Vector3d viewpoint(this->Viewpoint);
  if (this->Occlusion && !viewpoint.allFinite())
  {
    vtkErrorMacro(<< "The viewpoint is not finite.");
    return 0;
  }
  std::optional<neuralmesh::MeasuredSurface> surface;
  try
  {
    surface.emplace(vtkTriangleMeshCollector::Collect(input));
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  // In coordinates of its own: the bounding box around the origin, with a diagonal of 1.
  const Eigen::AlignedBox3d box = surface->box();
  const double unit = box.isEmpty() ? 0.0 : box.diagonal().stableNorm();
  if (unit > 0.0)
  {
    surface->transform(box.center(), unit);
  }
  if (!(unit > 0.0) || !surface->hasArea())
  {
    vtkErrorMacro(<< "The surface has no triangle with an area.");
    return 0;
  }

  neuralmesh::CloudOptions options;
  options.count = static_cast<std::size_t>(this->NumberOfPoints);
  options.seed = static_cast<std::uint64_t>(this->Seed);
  options.noise = this->Noise;
  options.outliers = this->Outliers;
  options.holes = static_cast<unsigned>(this->Holes);
  options.holeRadius = this->HoleRadius;
  if (this->Occlusion)
  {
    options.viewpoint = (viewpoint - box.center()) / unit;
  }
  vtkNeuralMeshProgress progress(this);
  neuralmesh::TriangleMesh cloud;
  cloud.points = neuralmesh::generateCloud(
    surface->mesh(), options, [&progress](double fraction) { return progress.Report(fraction); });
  this->AbortExecute = 0;
  for (Eigen::Vector3d& point : cloud.points)
  {
    point = box.center() + unit * point;
  }
  const bool isDouble = input->GetPoints()->GetDataType() == VTK_DOUBLE;
  output->SetPoints(
    vtkTriangleMeshCollector::MakePoints(cloud, isDouble ? DOUBLE_PRECISION : SINGLE_PRECISION));
  output->SetVerts(MakeCell(output->GetNumberOfPoints()));
  return 1;
}

void vtkNeuralMeshScan::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Noise: " << this->Noise << "\n";
  os << indent << "Outliers: " << this->Outliers << "\n";
  os << indent << "Holes: " << this->Holes << "\n";
  os << indent << "HoleRadius: " << this->HoleRadius << "\n";
  os << indent << "Occlusion: " << this->Occlusion << "\n";
  os << indent << "Viewpoint: (" << this->Viewpoint[0] << ", " << this->Viewpoint[1] << ", "
     << this->Viewpoint[2] << ")\n";
}
