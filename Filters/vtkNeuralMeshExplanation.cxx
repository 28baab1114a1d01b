// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshExplanation.h"

#include "cloud/PointCloud.h"
#include "run/Explanation.h"
#include "vtkExplainedPoints.h"
#include "vtkMeasuredSurface.h"
#include "vtkPointCloudCollector.h"

#include "vtkCellLocator.h"
#include "vtkGenericCell.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkNeuralMeshExplanation);

namespace
{
/// Between two looks at whether to go on.
constexpr std::size_t PointsPerLook = 4096;
/// A place is on an edge if it is no farther from it than so many of its lengths.
constexpr double OnEdge = 1e-6;

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A surface in the coordinates of the cloud, and its edges of one triangle.
class ExplainingSurface
{
public:
  explicit ExplainingSurface(const vtkMeasuredSurface& surface)
    : Mesh(surface.GetMesh())
    , Data(surface.MakePolyData())
  {
    this->Locator->SetDataSet(this->Data);
    this->Locator->BuildLocator();
    double length = 0.0;
    for (const auto& triangle : this->Mesh.triangles)
    {
      for (std::size_t corner = 0; corner < triangle.size(); ++corner)
      {
        const auto [a, b] = std::minmax(triangle[corner], triangle[(corner + 1) % triangle.size()]);
        ++this->TrianglesAt[{ a, b }];
        length += (this->Mesh.points[a] - this->Mesh.points[b]).norm();
      }
    }
    this->MeanEdge = length / static_cast<double>(3 * this->Mesh.triangles.size());
  }

  double GetMeanEdge() const { return this->MeanEdge; }

  struct Found
  {
    double Distance;
    bool IsOnBoundary;
  };

  Found Find(const Eigen::Vector3d& point)
  {
    Eigen::Vector3d place;
    double squaredDistance = 0.0;
    vtkIdType id = 0;
    int subId = 0;
    this->Locator->FindClosestPoint(
      point.data(), place.data(), this->Cell, id, subId, squaredDistance);
    const auto& triangle = this->Mesh.triangles[static_cast<std::size_t>(id)];
    bool isOnBoundary = false;
    for (std::size_t corner = 0; corner < triangle.size(); ++corner)
    {
      const auto [a, b] = std::minmax(triangle[corner], triangle[(corner + 1) % triangle.size()]);
      isOnBoundary = isOnBoundary ||
        (this->TrianglesAt.at({ a, b }) == 1 &&
          IsOn(place, this->Mesh.points[a], this->Mesh.points[b]));
    }
    return { std::sqrt(squaredDistance), isOnBoundary };
  }

private:
  static bool IsOn(const Eigen::Vector3d& place, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  {
    const Eigen::Vector3d side = b - a;
    return (place - a).cross(side).norm() <= OnEdge * side.squaredNorm();
  }

  const neuralmesh::TriangleMesh& Mesh;
  vtkNew<vtkPolyData> Data;
  vtkNew<vtkCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
  std::map<Edge, int> TrianglesAt;
  double MeanEdge = 0.0;
};

/// The distances of all points; fewer if the filter was told to end.
neuralmesh::PointDistances DistancesTo(
  ExplainingSurface& surface, const neuralmesh::PointCloud& cloud, vtkAlgorithm* filter)
{
  neuralmesh::PointDistances result;
  result.meanEdge = surface.GetMeanEdge();
  const std::size_t count = cloud.points().size();
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i % PointsPerLook == 0)
    {
      filter->UpdateProgress(static_cast<double>(i) / static_cast<double>(count));
      if (filter->GetAbortExecute())
      {
        break;
      }
    }
    const auto found = surface.Find(cloud.points()[i].toDouble());
    result.points.push_back(i);
    result.distances.push_back(static_cast<float>(found.Distance));
    result.isBeyondBoundary.push_back(found.IsOnBoundary ? 1 : 0);
  }
  return result;
}
}

vtkNeuralMeshExplanation::vtkNeuralMeshExplanation() { this->SetNumberOfInputPorts(2); }

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
    vtkErrorMacro(<< (cloud.points().empty() ? "No point of the input is finite."
                                             : "All points of the input coincide."));
    return 0;
  }
  try
  {
    vtkMeasuredSurface surface(vtkPolyData::GetData(inputVector[1]));
    surface.Transform(cloud.toInput({}), cloud.unit());
    if (!surface.HasArea())
    {
      vtkErrorMacro(<< "The mesh has no triangle with an area.");
      return 0;
    }
    ExplainingSurface explaining(surface);
    neuralmesh::PointDistances distances = DistancesTo(explaining, cloud, this);
    if (distances.points.size() == cloud.points().size())
    {
      neuralmesh::ExplanationRules rules;
      rules.leastPiece = this->SmallestPiece;
      const neuralmesh::Explanation explanation =
        neuralmesh::explain(cloud, std::move(distances), rules);
      vtkPolyData* output = vtkPolyData::GetData(outputVector);
      vtkExplainedPoints::Fill(collector, cloud, explanation, output);
    }
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< "The mesh cannot be used: " << error.what() << ".");
    return 0;
  }
  return 1;
}

void vtkNeuralMeshExplanation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SmallestPiece: " << this->SmallestPiece << "\n";
}
