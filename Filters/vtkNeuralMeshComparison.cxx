// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNeuralMeshComparison.h"

#include "vtkMeasuredSurface.h"

#include "vtkCellLocator.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkHausdorffDistancePointSetFilter.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkVersionMacros.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkNeuralMeshComparison);

namespace
{
/// Angles settle with fewer samples than the tail of the distances.
constexpr std::size_t MostAngleSamples = 20000;
/// Where the maximum is looked for: in so many triangles, with so many steps that get smaller.
constexpr std::size_t ClimbedTriangles = 128;
constexpr int ClimbSteps = 96;
constexpr int StepsOfOneSize = 8;

/// The two surfaces, moved and scaled so that the bounding box of the reference has its centre in
/// the origin and a diagonal of 1.
struct SurfacePair
{
  SurfacePair(vtkPolyData* reference, vtkPolyData* result)
    : Reference(reference)
    , Result(result)
  {
    const Eigen::AlignedBox3d box = this->Reference.GetBox();
    this->Unit = box.isEmpty() ? 0.0 : box.diagonal().stableNorm();
    if (this->Unit > 0.0)
    {
      this->Reference.Transform(box.center(), this->Unit);
      this->Result.Transform(box.center(), this->Unit);
    }
    if (!(this->Unit > 0.0) || !this->Reference.HasArea())
    {
      throw std::runtime_error("The reference has no triangle with an area.");
    }
    if (!this->Result.HasArea())
    {
      throw std::runtime_error("The result has no triangle with an area.");
    }
  }

  vtkMeasuredSurface Reference;
  vtkMeasuredSurface Result;
  double Unit; ///< the diagonal, in units of the input
};

/// Distances of the vertices and then of the samples of a surface, in its coordinates.
struct Distances
{
  std::vector<double> OfVertices;
  std::vector<double> OfSamples;
};

Distances TakeDistances(vtkDataObject* measured, const vtkMeasuredSurface& surface)
{
  auto* array = vtkDoubleArray::SafeDownCast(
    vtkDataSet::SafeDownCast(measured)->GetPointData()->GetArray("Distance"));
  const double* first = array->GetPointer(0);
  const double* samples = first + surface.GetMesh().points.size();
  return { { first, samples }, { samples, samples + surface.GetSamples().size() } };
}

double Mean(const std::vector<double>& distances)
{
  double sum = 0.0;
  for (const double distance : distances)
  {
    sum += distance;
  }
  return sum / static_cast<double>(distances.size());
}

double RootMeanSquare(const std::vector<double>& distances)
{
  double sum = 0.0;
  for (const double distance : distances)
  {
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(distances.size()));
}

/// The smallest of the distances that 99 % of them do not exceed.
double Percentile99(std::vector<double> distances)
{
  const auto place =
    distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) * 99 / 100);
  std::nth_element(distances.begin(), place, distances.end());
  return *place;
}

/// Finds the nearest point of a surface, and its triangle; of equally near ones always the same, which
/// vtkStaticCellLocator does not with some backends of vtkSMPTools.
class NearestPoint
{
public:
  explicit NearestPoint(vtkPolyData* surface)
  {
    this->Locator->SetDataSet(surface);
    this->Locator->BuildLocator();
  }

  struct Found
  {
    double Distance;
    std::size_t Triangle;
  };

  Found Find(const Eigen::Vector3d& point)
  {
    double nearest[3], squaredDistance = 0.0;
    vtkIdType triangle = 0;
    int subId = 0;
    this->Locator->FindClosestPoint(
      point.data(), nearest, this->Cell, triangle, subId, squaredDistance);
    return { std::sqrt(squaredDistance), static_cast<std::size_t>(triangle) };
  }

private:
  vtkNew<vtkCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

/// The triangles of the samples with the largest distances, with those samples, `most` of them.
std::vector<vtkMeasuredSurface::Sample> FarthestSamples(
  const std::vector<double>& distances, const vtkMeasuredSurface& surface, std::size_t most)
{
  std::vector<std::size_t> order(distances.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    { return distances[a] != distances[b] ? distances[a] > distances[b] : a < b; });
  std::vector<vtkMeasuredSurface::Sample> farthest;
  std::set<std::size_t> triangles;
  for (std::size_t i = 0; i < order.size() && farthest.size() < most; ++i)
  {
    const auto& sample = surface.GetSamples()[order[i]];
    if (triangles.insert(sample.triangle).second)
    {
      farthest.push_back(sample);
    }
  }
  return farthest;
}

/// Over the samples, the vertices of triangles, and what is found by climbing on from the farthest
/// samples: the peaks are narrow.
double Maximum(const Distances& distances, const vtkMeasuredSurface& from, NearestPoint& to,
  neuralmesh::Random& random)
{
  double maximum = *std::max_element(distances.OfSamples.begin(), distances.OfSamples.end());
  for (const auto& triangle : from.GetMesh().triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      maximum = std::max(maximum, distances.OfVertices[corner]);
    }
  }
  const neuralmesh::SurfaceSampler sampler(from.GetMesh());
  for (auto& [point, triangle] : FarthestSamples(distances.OfSamples, from, ClimbedTriangles))
  {
    double distance = to.Find(point).Distance;
    for (int step = 0; step < ClimbSteps; ++step)
    {
      const double size = std::ldexp(1.0, -step / StepsOfOneSize);
      const Eigen::Vector3d next =
        (1.0 - size) * point + size * sampler.drawFromTriangle(triangle, random);
      const double nextDistance = to.Find(next).Distance;
      if (nextDistance > distance)
      {
        distance = nextDistance;
        point = next;
      }
    }
    maximum = std::max(maximum, distance);
  }
  return maximum;
}

/// Mean angle, in degrees, between the normals of `from` at samples and those of `to` at the
/// nearest points.
double MeanNormalAngle(
  const vtkMeasuredSurface& from, const vtkMeasuredSurface& to, NearestPoint& nearestPoint)
{
  const auto& samples = from.GetSamples();
  const std::size_t stride = (samples.size() + MostAngleSamples - 1) / MostAngleSamples;
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < samples.size(); i += stride)
  {
    const std::size_t nearest = nearestPoint.Find(samples[i].point).Triangle;
    const Eigen::Vector3d a = from.GetNormal(from.GetMesh().triangles[samples[i].triangle]);
    const Eigen::Vector3d b = to.GetNormal(to.GetMesh().triangles[nearest]);
    sum += std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
    ++count;
  }
  return vtkMath::DegreesFromRadians(sum / static_cast<double>(count));
}

/// Adds the distances, in units of the input, to the points of a mesh.
void AddDistances(vtkPolyData* mesh, const std::vector<double>& distances, double unit)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Distance");
  array->SetNumberOfValues(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const Eigen::Vector3d point(mesh->GetPoint(i));
    array->SetValue(
      i, point.allFinite() ? unit * distances[static_cast<std::size_t>(i)] : vtkMath::Nan());
  }
  mesh->GetPointData()->AddArray(array);
  mesh->GetPointData()->SetActiveScalars("Distance");
}

bool IsEmpty(vtkPolyData* data)
{
  return data->GetNumberOfPoints() == 0 && data->GetNumberOfCells() == 0;
}
}

vtkNeuralMeshComparison::vtkNeuralMeshComparison()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
}

vtkNeuralMeshComparison::~vtkNeuralMeshComparison() = default;

void vtkNeuralMeshComparison::SetReferenceConnection(vtkAlgorithmOutput* port)
{
  this->SetInputConnection(1, port);
}

void vtkNeuralMeshComparison::SetReferenceData(vtkPolyData* reference)
{
  this->SetInputData(1, reference);
}

vtkPolyData* vtkNeuralMeshComparison::GetReferenceOutput() { return this->GetOutput(1); }

vtkTable* vtkNeuralMeshComparison::GetTableOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

vtkNeuralMeshComparison::Figures vtkNeuralMeshComparison::GetFigures(int direction) const
{
  const bool exists = direction == REFERENCE_TO_RESULT || direction == RESULT_TO_REFERENCE;
  return exists ? this->FiguresOfDirections[static_cast<std::size_t>(direction)] : Figures();
}

double vtkNeuralMeshComparison::GetMean(int direction) { return this->GetFigures(direction).Mean; }

double vtkNeuralMeshComparison::GetRMS(int direction) { return this->GetFigures(direction).RMS; }

double vtkNeuralMeshComparison::GetPercentile99(int direction)
{
  return this->GetFigures(direction).Percentile99;
}

double vtkNeuralMeshComparison::GetMaximum(int direction)
{
  return this->GetFigures(direction).Maximum;
}

double vtkNeuralMeshComparison::GetNormalAngle(int direction)
{
  return this->GetFigures(direction).NormalAngle;
}

double vtkNeuralMeshComparison::GetReferenceDiagonal() { return this->ReferenceDiagonal; }

int vtkNeuralMeshComparison::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  return 1;
}

int vtkNeuralMeshComparison::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkTable" : "vtkPolyData");
  return 1;
}

bool vtkNeuralMeshComparison::Advance(double progress)
{
  this->UpdateProgress(progress);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 0)
  return !this->CheckAbort();
#else
  return !this->GetAbortExecute();
#endif
}

int vtkNeuralMeshComparison::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* resultInput = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* referenceInput = vtkPolyData::GetData(inputVector[1]);
  vtkPolyData* resultOutput = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* referenceOutput = vtkPolyData::GetData(outputVector, 1);
  this->FiguresOfDirections = {};
  this->ReferenceDiagonal = vtkMath::Nan();
  if (IsEmpty(resultInput) && IsEmpty(referenceInput))
  {
    return 1;
  }
  std::optional<SurfacePair> surfaces;
  try
  {
    surfaces.emplace(referenceInput, resultInput);
  }
  catch (const std::runtime_error& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  vtkMeasuredSurface& reference = surfaces->Reference;
  vtkMeasuredSurface& result = surfaces->Result;
  const auto count = static_cast<std::size_t>(this->NumberOfSamples);
  neuralmesh::Random random(static_cast<std::uint64_t>(this->Seed));
  reference.Draw(count, random);
  result.Draw(count, random);
  const auto referenceData = reference.MakePolyData();
  const auto resultData = result.MakePolyData();
  if (!this->Advance(0.05))
  {
    return 1;
  }
  vtkNew<vtkHausdorffDistancePointSetFilter> hausdorff;
  hausdorff->SetInputData(0, referenceData);
  hausdorff->SetInputData(1, resultData);
  hausdorff->SetTargetDistanceMethodToPointToCell();
  hausdorff->Update();
  const auto fromReference = TakeDistances(hausdorff->GetOutputDataObject(0), reference);
  const auto fromResult = TakeDistances(hausdorff->GetOutputDataObject(1), result);
  if (!this->Advance(0.8))
  {
    return 1;
  }
  const double unit = surfaces->Unit;
  const auto figures = [&](const Distances& distances, const vtkMeasuredSurface& from,
                         const vtkMeasuredSurface& to, vtkPolyData* toData)
  {
    NearestPoint nearest(toData);
    const std::vector<double>& samples = distances.OfSamples;
    return Figures{ unit * Mean(samples), unit * RootMeanSquare(samples),
      unit * Percentile99(samples), unit * Maximum(distances, from, nearest, random),
      MeanNormalAngle(from, to, nearest) };
  };
  const Figures referenceToResult = figures(fromReference, reference, result, resultData);
  if (!this->Advance(0.9))
  {
    return 1;
  }
  this->FiguresOfDirections = { referenceToResult,
    figures(fromResult, result, reference, referenceData) };
  this->ReferenceDiagonal = unit;

  referenceOutput->ShallowCopy(referenceInput);
  AddDistances(referenceOutput, fromReference.OfVertices, unit);
  resultOutput->ShallowCopy(resultInput);
  AddDistances(resultOutput, fromResult.OfVertices, unit);
  this->FillTable(vtkTable::GetData(outputVector, 2));
  return 1;
}

void vtkNeuralMeshComparison::FillTable(vtkTable* table) const
{
  vtkNew<vtkStringArray> directions;
  directions->SetName("Direction");
  directions->InsertNextValue("reference to result");
  directions->InsertNextValue("result to reference");
  table->AddColumn(directions);
  const auto add = [this, table](const std::string& name, double Figures::*figure, double factor)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name.c_str());
    for (const Figures& figures : this->FiguresOfDirections)
    {
      column->InsertNextValue(factor * figures.*figure);
    }
    table->AddColumn(column);
  };
  const std::pair<const char*, double Figures::*> distances[] = { { "Mean", &Figures::Mean },
    { "RMS", &Figures::RMS }, { "Percentile99", &Figures::Percentile99 },
    { "Maximum", &Figures::Maximum } };
  for (const auto& [name, figure] : distances)
  {
    add(name, figure, 1.0);
  }
  for (const auto& [name, figure] : distances)
  {
    add(std::string(name) + "Percent", figure, 100.0 / this->ReferenceDiagonal);
  }
  add("NormalAngle", &Figures::NormalAngle, 1.0);
}

void vtkNeuralMeshComparison::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "ReferenceDiagonal: " << this->ReferenceDiagonal << "\n";
  for (const int direction : { REFERENCE_TO_RESULT, RESULT_TO_REFERENCE })
  {
    const Figures figures = this->GetFigures(direction);
    os << indent << (direction == REFERENCE_TO_RESULT ? "ReferenceToResult:" : "ResultToReference:")
       << " Mean " << figures.Mean << ", RMS " << figures.RMS << ", Percentile99 "
       << figures.Percentile99 << ", Maximum " << figures.Maximum << ", NormalAngle "
       << figures.NormalAngle << "\n";
  }
}
