// SPDX-License-Identifier: BSD-3-Clause
// Promises: distances, angles and the measures of both ways are those of known surfaces, over the surfaces and
// not at the vertices alone, and the table and its field data have them; wrong inputs are errors; a seed gives the same figures, also where triangles
// are equally near; neither offset nor scale matters; an abort is obeyed. What VTK's own filter measures from
// points to cells, at the vertices and at samples that are drawn in another way, agrees.
#include "FilterTesting.h"

#include "vtkNeuralMeshComparison.h"

#include "base/Random.h"

#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkHausdorffDistancePointSetFilter.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkTable.h"
#include "vtkTriangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace
{
constexpr int ToResult = vtkNeuralMeshComparison::REFERENCE_TO_RESULT;
constexpr int ToReference = vtkNeuralMeshComparison::RESULT_TO_REFERENCE;

bool IsNear(double value, double expected, double tolerance)
{
  return std::abs(value - expected) <= tolerance;
}

/** A rectangle in the plane z, as one quadrangle, in double precision. */
vtkNew<vtkPolyData> Rectangle(
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

void Prepare(vtkNeuralMeshComparison* filter, vtkPolyData* reference, vtkPolyData* result)
{
  filter->SetReferenceData(reference);
  filter->SetInputData(result);
  filter->SetNumberOfSamples(5000);
}

double Distance(vtkPolyData* mesh, vtkIdType point)
{
  auto* array = vtkDoubleArray::SafeDownCast(mesh->GetPointData()->GetArray("Distance"));
  return array ? array->GetValue(point) : -1.0;
}

int CheckSpheres()
{
  vtkNew<vtkSphereSource> inner, outer;
  for (vtkSphereSource* sphere : { inner.Get(), outer.Get() })
  {
    sphere->SetThetaResolution(60);
    sphere->SetPhiResolution(60);
  }
  inner->SetRadius(1.0);
  outer->SetRadius(1.1);
  vtkNew<vtkNeuralMeshComparison> filter;
  filter->SetReferenceConnection(inner->GetOutputPort());
  filter->SetInputConnection(outer->GetOutputPort());
  filter->SetNumberOfSamples(2000);
  filter->Update();
  for (const int direction : { ToResult, ToReference })
  {
    CHECK(IsNear(filter->GetMean(direction), 0.1, 1e-3));
    CHECK(IsNear(filter->GetRMS(direction), 0.1, 1e-3));
    CHECK(IsNear(filter->GetPercentile99(direction), 0.1, 1e-3));
    CHECK(IsNear(filter->GetMaximum(direction), 0.1, 2e-3));
    CHECK(filter->GetNormalAngle(direction) < 1.0);
    vtkPolyData* mesh = direction == ToResult ? filter->GetReferenceOutput() : filter->GetOutput();
    vtkPolyData* input = direction == ToResult ? inner->GetOutput() : outer->GetOutput();
    CHECK(mesh->GetNumberOfPoints() == input->GetNumberOfPoints());
    CHECK(mesh->GetNumberOfPolys() == input->GetNumberOfPolys());
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      CHECK(IsNear(Distance(mesh, i), 0.1, 2e-3));
    }
  }
  CHECK(IsNear(filter->GetReferenceDiagonal(), 2.0 * std::sqrt(3.0), 0.01));
  return EXIT_SUCCESS;
}

int CheckShiftedAndTilted()
{
  const auto reference = Rectangle(1, 1, 0);
  const auto shifted = Rectangle(1, 1, 0.25);
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, reference, shifted);
  filter->Update();
  for (const int direction : { ToResult, ToReference })
  {
    for (const double figure : { filter->GetMean(direction), filter->GetRMS(direction),
           filter->GetPercentile99(direction), filter->GetMaximum(direction) })
    {
      CHECK(IsNear(figure, 0.25, 1e-9));
    }
    CHECK(IsNear(filter->GetNormalAngle(direction), 0.0, 1e-6));
  }
  CHECK(IsNear(Distance(filter->GetOutput(), 2), 0.25, 1e-9));

  // Tilted by 30 degrees, and upside down: only the angle between the planes counts.
  const auto tilted = Rectangle(1, 1, 0);
  tilted->GetPoints()->SetPoint(2, 1, std::sqrt(0.75), 0.5);
  tilted->GetPoints()->SetPoint(3, 0, std::sqrt(0.75), 0.5);
  tilted->GetPoints()->Modified();
  tilted->ReverseCell(0);
  Prepare(filter, reference, tilted);
  filter->Update();
  CHECK(IsNear(filter->GetNormalAngle(ToResult), 30.0, 1e-6));
  CHECK(IsNear(filter->GetNormalAngle(ToReference), 30.0, 1e-6));
  CHECK(IsNear(filter->GetMean(ToReference), 0.25, 1e-2));
  CHECK(IsNear(filter->GetMaximum(ToReference), 0.5, 1e-9));
  return EXIT_SUCCESS;
}

int CheckAsymmetric()
{
  // The result covers half of the reference. Vertices alone would give a mean of 0.5.
  const auto reference = Rectangle(2, 1, 0);
  const auto result = Rectangle(1, 1, 0);
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, reference, result);
  filter->Update();
  CHECK(IsNear(filter->GetMean(ToResult), 0.25, 1e-2));
  CHECK(IsNear(filter->GetRMS(ToResult), std::sqrt(1.0 / 6.0), 1e-2));
  CHECK(IsNear(filter->GetPercentile99(ToResult), 0.98, 1e-2));
  CHECK(IsNear(filter->GetMaximum(ToResult), 1.0, 1e-9));
  CHECK(IsNear(filter->GetMaximum(ToReference), 0.0, 1e-9));
  CHECK(IsNear(Distance(filter->GetReferenceOutput(), 1), 1.0, 1e-9));
  CHECK(IsNear(Distance(filter->GetReferenceOutput(), 0), 0.0, 1e-9));

  vtkTable* table = filter->GetTableOutput();
  CHECK(table->GetNumberOfRows() == 2);
  CHECK(table->GetNumberOfColumns() == 16);
  CHECK(table->GetValueByName(0, "Direction").ToString() == "reference to result");
  CHECK(table->GetValueByName(1, "Direction").ToString() == "result to reference");
  CHECK(table->GetValueByName(0, "Mean").ToDouble() == filter->GetMean(ToResult));
  CHECK(table->GetValueByName(0, "NormalAngle").ToDouble() == filter->GetNormalAngle(ToResult));
  CHECK(
    IsNear(table->GetValueByName(0, "MaximumPercent").ToDouble(), 100.0 / std::sqrt(5.0), 1e-6));
  CHECK(IsNear(filter->GetReferenceDiagonal(), std::sqrt(5.0), 1e-12));
  return EXIT_SUCCESS;
}

/** Two squares with a common edge, the second one upright. */
vtkNew<vtkPolyData> Corner(double z)
{
  vtkNew<vtkPolyData> corner;
  corner->DeepCopy(Rectangle(1, 1, z));
  corner->GetPoints()->InsertNextPoint(1, 0, z + 1);
  corner->GetPoints()->InsertNextPoint(1, 1, z + 1);
  const std::array<vtkIdType, 4> ids{ 1, 4, 5, 2 };
  corner->InsertNextCell(VTK_QUAD, 4, ids.data());
  return corner;
}

int CheckMeasures()
{
  // Both corners have an edge of length 1, which are apart by the shift. It is 0.17 % of the diagonal.
  const double shift = 0.003;
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, Corner(0), Corner(shift));
  filter->Update();
  for (const int direction : { ToResult, ToReference })
  {
    CHECK(IsNear(filter->GetEdgeLength(direction), 1.0, 1e-12));
    CHECK(IsNear(filter->GetEdgeMean(direction), shift, 1e-9));
    CHECK(filter->GetNormalConsistency(direction) > 0.99);
  }
  // Seen from below, the wall goes on to where the shifted floor begins.
  CHECK(IsNear(filter->GetEdgeToSurface(ToResult), shift, 1e-9));
  CHECK(IsNear(filter->GetEdgeToSurface(ToReference), 0.0, 1e-9));
  CHECK(IsNear(filter->GetEdgeChamferDistance(), shift, 1e-9));
  CHECK(IsNear(filter->GetHausdorffDistance(), shift, 1e-9));
  CHECK(IsNear(filter->GetChamferDistance(), 0.5 * shift, 0.05 * shift));
  CHECK(IsNear(filter->GetSquaredChamferDistance(), shift * shift, 0.05 * shift * shift));
  constexpr int tenth = vtkNeuralMeshComparison::TENTH_PERCENT;
  constexpr int half = vtkNeuralMeshComparison::HALF_PERCENT;
  CHECK(IsNear(filter->GetPrecision(tenth), 0.5, 0.02));
  CHECK(IsNear(filter->GetRecall(tenth), 0.5, 0.02));
  CHECK(filter->GetPrecision(half) == 1.0 && filter->GetRecall(half) == 1.0);
  CHECK(filter->GetFScore(half) == 1.0);
  CHECK(std::isnan(filter->GetFScore(2)) && std::isnan(filter->GetRecall(-1)));
  CHECK(std::isnan(filter->GetEdgeMean(2)) && std::isnan(filter->GetNormalConsistency(-1)));

  vtkTable* table = filter->GetTableOutput();
  vtkFieldData* both = table->GetFieldData();
  CHECK(both->GetNumberOfArrays() == 15);
  const double percent = 100.0 / filter->GetReferenceDiagonal();
  const std::pair<const char*, double> figures[] = { { "Chamfer", filter->GetChamferDistance() },
    { "ChamferPercent", percent * filter->GetChamferDistance() },
    { "ChamferSquared", filter->GetSquaredChamferDistance() },
    { "Hausdorff", filter->GetHausdorffDistance() },
    { "HausdorffPercent", percent * filter->GetHausdorffDistance() },
    { "NormalAngle", filter->GetNormalAngle() },
    { "NormalConsistency", filter->GetNormalConsistency() },
    { "Precision0_1", filter->GetPrecision(tenth) }, { "Recall0_1", filter->GetRecall(tenth) },
    { "FScore0_1", filter->GetFScore(tenth) }, { "Precision0_5", filter->GetPrecision(half) },
    { "Recall0_5", filter->GetRecall(half) }, { "FScore0_5", filter->GetFScore(half) },
    { "EdgeChamfer", filter->GetEdgeChamferDistance() },
    { "EdgeChamferPercent", percent * filter->GetEdgeChamferDistance() } };
  for (const auto& [name, figure] : figures)
  {
    auto* array = vtkDoubleArray::SafeDownCast(both->GetArray(name));
    CHECK(array && array->GetNumberOfValues() == 1 && array->GetValue(0) == figure);
  }
  CHECK(table->GetValueByName(0, "EdgeLength").ToDouble() == filter->GetEdgeLength(ToResult));
  CHECK(table->GetValueByName(1, "EdgeMean").ToDouble() == filter->GetEdgeMean(ToReference));
  CHECK(IsNear(table->GetValueByName(0, "EdgeToSurfacePercent").ToDouble(), percent * shift, 1e-9));
  CHECK(table->GetValueByName(0, "NormalConsistency").ToDouble() ==
    filter->GetNormalConsistency(ToResult));

  // Nothing is left of it where nothing is sharp, and after a run that fails.
  Prepare(filter, Rectangle(1, 1, 0), Rectangle(1, 1, 0));
  filter->Update();
  CHECK(filter->GetEdgeLength(ToResult) == 0.0);
  CHECK(std::isnan(filter->GetEdgeChamferDistance()));
  CHECK(std::isnan(filter->GetEdgeToSurface(ToResult)));
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  Prepare(filter, Rectangle(1, 1, 0), Rectangle(1, 0, 0));
  filter->Update();
  CHECK(messages->Errors == 1);
  for (const double figure : { filter->GetChamferDistance(), filter->GetSquaredChamferDistance(),
         filter->GetHausdorffDistance(), filter->GetNormalAngle(), filter->GetNormalConsistency(),
         filter->GetFScore(half), filter->GetEdgeLength(ToResult) })
  {
    CHECK(std::isnan(figure));
  }
  return EXIT_SUCCESS;
}

int CheckMaximumInsideTriangles()
{
  // A roof over a flat reference, its ridge between vertices of large triangles: no sample needs to
  // be near the farthest point, which is found all the same.
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& point : { std::array<double, 3>{ 0, 0, 0 }, { 4, 0, 0 }, { 4, 4, 0 },
         { 0, 4, 0 }, { 10, 0, 0 }, { 14, 0, 0 }, { 14, 4, 0 }, { 10, 4, 0 } })
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkPolyData> twoPatches;
  twoPatches->SetPoints(points);
  twoPatches->AllocateExact(2, 8);
  const std::array<vtkIdType, 8> ids{ 0, 1, 2, 3, 4, 5, 6, 7 };
  twoPatches->InsertNextCell(VTK_QUAD, 4, ids.data());
  twoPatches->InsertNextCell(VTK_QUAD, 4, ids.data() + 4);
  const auto bridge = Rectangle(14, 4, 0);
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, twoPatches, bridge);
  filter->SetNumberOfSamples(1000);
  filter->Update();
  // In the middle of the gap of 6, at 3 from either patch.
  CHECK(IsNear(filter->GetMaximum(ToReference), 3.0, 1e-3));
  CHECK(filter->GetMaximum(ToReference) <= 3.0 + 1e-9);
  return EXIT_SUCCESS;
}

int CheckSeed()
{
  vtkNew<vtkSphereSource> sphere;
  const auto reference = Rectangle(1, 1, 0);
  std::vector<double> means;
  for (const int seed : { 1, 1, 2 })
  {
    vtkNew<vtkNeuralMeshComparison> filter;
    sphere->Update();
    Prepare(filter, reference, sphere->GetOutput());
    filter->SetSeed(seed);
    filter->Update();
    means.push_back(filter->GetMean(ToReference));
  }
  CHECK(means[0] == means[1]);
  CHECK(means[0] != means[2]);
  CHECK(IsNear(means[0], means[2], 1e-2));
  return EXIT_SUCCESS;
}

int CheckEquallyNear()
{
  // From outside, the nearest point of many samples is on an edge or in a corner.
  vtkNew<vtkSphereSource> inner, outer;
  inner->SetThetaResolution(50);
  inner->SetPhiResolution(50);
  outer->SetRadius(0.55);
  std::vector<double> angles;
  for (int run = 0; run < 3; ++run)
  {
    vtkNew<vtkNeuralMeshComparison> filter;
    filter->SetReferenceConnection(inner->GetOutputPort());
    filter->SetInputConnection(outer->GetOutputPort());
    filter->SetNumberOfSamples(2000);
    filter->Update();
    angles.push_back(filter->GetNormalAngle(ToReference));
    CHECK(angles.back() == angles.front());
  }
  return EXIT_SUCCESS;
}

/** Points of a sphere, each moved by a wave that the other does not have. */
vtkNew<vtkPolyData> WavySphere(int resolution, double height)
{
  vtkNew<vtkSphereSource> source;
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->SetRadius(1.0);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  vtkNew<vtkPolyData> sphere;
  sphere->DeepCopy(source->GetOutput());
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    std::array<double, 3> point;
    sphere->GetPoint(i, point.data());
    const double factor = 1.0 + height * std::sin(5.0 * point[0]) * std::sin(4.0 * point[2]);
    sphere->GetPoints()->SetPoint(i, factor * point[0], factor * point[1], factor * point[2]);
  }
  return sphere;
}

/** The same surface with points in its triangles, as many in each, behind its own; and what part of the area
 * each of them stands for. */
vtkNew<vtkPolyData> WithSamples(vtkPolyData* mesh, int inEach, std::vector<double>& shares)
{
  vtkNew<vtkPolyData> result;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->DeepCopy(mesh->GetPoints());
  neuralmesh::Random random(1);
  double whole = 0.0;
  vtkNew<vtkIdList> ids;
  for (mesh->GetPolys()->InitTraversal(); mesh->GetPolys()->GetNextCell(ids);)
  {
    std::array<std::array<double, 3>, 3> corners;
    for (vtkIdType i = 0; i < 3; ++i)
    {
      mesh->GetPoint(ids->GetId(i), corners[static_cast<std::size_t>(i)].data());
    }
    const double area =
      vtkTriangle::TriangleArea(corners[0].data(), corners[1].data(), corners[2].data());
    for (int sample = 0; sample < inEach; ++sample)
    {
      double b = random.uniform(), c = random.uniform();
      if (b + c > 1.0)
      {
        b = 1.0 - b;
        c = 1.0 - c;
      }
      std::array<double, 3> place;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] =
          (1.0 - b - c) * corners[0][axis] + b * corners[1][axis] + c * corners[2][axis];
      }
      points->InsertNextPoint(place.data());
      shares.push_back(area / inEach);
    }
    whole += area;
  }
  for (double& share : shares)
  {
    share /= whole;
  }
  result->SetPoints(points);
  result->SetPolys(mesh->GetPolys());
  return result;
}

int CheckAgainstHausdorff()
{
  const auto reference = WavySphere(31, 0.02);
  const auto result = WavySphere(23, -0.03);
  vtkNew<vtkNeuralMeshComparison> filter;
  filter->SetReferenceData(reference);
  filter->SetInputData(result);
  filter->SetNumberOfSamples(50000);
  filter->Update();

  std::array<std::vector<double>, 2> shares;
  const auto ofReference = WithSamples(reference, 20, shares[ToResult]);
  const auto ofResult = WithSamples(result, 20, shares[ToReference]);
  vtkNew<vtkHausdorffDistancePointSetFilter> referee;
  referee->SetInputData(0, ofReference);
  referee->SetInputData(1, ofResult);
  referee->SetTargetDistanceMethodToPointToCell();
  referee->Update();
  for (const int direction : { ToResult, ToReference })
  {
    vtkPolyData* mesh = direction == ToResult ? filter->GetReferenceOutput() : filter->GetOutput();
    auto* measured =
      vtkPolyData::SafeDownCast(referee->GetOutputDataObject(direction == ToResult ? 0 : 1));
    const vtkIdType vertices = mesh->GetNumberOfPoints();
    double farthest = 0.0;
    for (vtkIdType i = 0; i < vertices; ++i)
    {
      CHECK(IsNear(Distance(mesh, i), Distance(measured, i), 1e-9));
      farthest = std::max(farthest, Distance(measured, i));
    }
    double mean = 0.0, square = 0.0, within = 0.0;
    for (vtkIdType i = vertices; i < measured->GetNumberOfPoints(); ++i)
    {
      const double distance = Distance(measured, i);
      const double share =
        shares[static_cast<std::size_t>(direction)][static_cast<std::size_t>(i - vertices)];
      mean += share * distance;
      square += share * distance * distance;
      within += distance <= filter->GetPercentile99(direction) ? share : 0.0;
      farthest = std::max(farthest, distance);
    }
    CHECK(IsNear(filter->GetMean(direction) / mean, 1.0, 0.01));
    CHECK(IsNear(filter->GetRMS(direction) / std::sqrt(square), 1.0, 0.01));
    CHECK(IsNear(within, 0.99, 0.002));
    CHECK(filter->GetMaximum(direction) >= 0.999 * farthest);
    CHECK(filter->GetMaximum(direction) <= 1.01 * farthest);
  }
  return EXIT_SUCCESS;
}

int CheckOffsetAndScale()
{
  for (const auto& [offset, scale] : { std::pair(1e7, 1.0), { 0.0, 1e-30 }, { 0.0, 1e30 } })
  {
    const std::array<double, 3> corner{ offset, -offset, offset };
    const auto reference = Rectangle(scale, scale, 0, corner);
    const auto result = Rectangle(scale, scale, 0.001 * scale, corner);
    vtkNew<vtkNeuralMeshComparison> filter;
    Prepare(filter, reference, result);
    filter->Update();
    CHECK(IsNear(filter->GetMean(ToReference) / scale, 0.001, 1e-8));
    CHECK(IsNear(filter->GetMaximum(ToResult) / scale, 0.001, 1e-8));
    CHECK(IsNear(Distance(filter->GetOutput(), 1) / scale, 0.001, 1e-8));
  }
  return EXIT_SUCCESS;
}

int CheckUncleanInput()
{
  // A point that is not finite, an unused one, and triangles without area disturb nothing.
  const auto reference = Rectangle(1, 1, 0);
  const auto result = Rectangle(1, 1, 0.5);
  result->GetPoints()->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  result->GetPoints()->InsertNextPoint(0, 0, 7);
  for (const auto& ids : { std::array<vtkIdType, 3>{ 0, 1, 4 }, { 0, 0, 5 } })
  {
    result->InsertNextCell(VTK_TRIANGLE, 3, ids.data());
  }
  vtkNew<vtkNeuralMeshComparison> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  Prepare(filter, reference, result);
  filter->Update();
  CHECK(messages->Errors == 0);
  CHECK(IsNear(filter->GetMaximum(ToReference), 0.5, 1e-9));
  CHECK(IsNear(filter->GetMaximum(ToResult), 0.5, 1e-9));
  CHECK(std::isnan(Distance(filter->GetOutput(), 4)));
  CHECK(IsNear(Distance(filter->GetOutput(), 5), 7.0, 1e-9));
  return EXIT_SUCCESS;
}

int CheckStrips()
{
  // The same rectangle as a strip.
  const auto reference = Rectangle(2, 1, 0);
  vtkNew<vtkPolyData> strip;
  strip->SetPoints(reference->GetPoints());
  const std::array<vtkIdType, 4> ids{ 0, 1, 3, 2 };
  strip->AllocateExact(0, 0, 0, 0, 0, 0, 1, 4);
  strip->InsertNextCell(VTK_TRIANGLE_STRIP, 4, ids.data());
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, reference, strip);
  filter->Update();
  CHECK(filter->GetMaximum(ToResult) < 1e-9);
  CHECK(filter->GetMaximum(ToReference) < 1e-9);
  CHECK(filter->GetOutput()->GetNumberOfStrips() == 1);
  return EXIT_SUCCESS;
}

int CheckErrors()
{
  const auto good = Rectangle(1, 1, 0);
  const auto pointsAlone = FilterTesting::SphereCloud(10);
  const auto flat = Rectangle(1, 0, 0);
  const auto broken = Rectangle(1, 1, 0);
  const std::array<vtkIdType, 3> beyond{ 0, 1, 99 };
  broken->InsertNextCell(VTK_TRIANGLE, 3, beyond.data());
  vtkNew<vtkPolyData> empty;
  for (vtkPolyData* bad : { pointsAlone.Get(), flat.Get(), broken.Get(), empty.Get() })
  {
    for (const bool asReference : { true, false })
    {
      vtkNew<vtkNeuralMeshComparison> filter;
      vtkNew<FilterTesting::MessageCounter> messages;
      messages->Observe(filter);
      messages->Observe(filter->GetExecutive());
      Prepare(filter, asReference ? bad : good.Get(), asReference ? good.Get() : bad);
      filter->Update();
      CHECK(messages->Errors > 0);
      CHECK(filter->GetTableOutput()->GetNumberOfRows() == 0);
      CHECK(std::isnan(filter->GetMean(ToResult)));
    }
  }
  vtkNew<vtkNeuralMeshComparison> filter;
  vtkNew<FilterTesting::MessageCounter> messages;
  messages->Observe(filter);
  messages->Observe(filter->GetExecutive());
  Prepare(filter, empty, empty);
  filter->Update();
  CHECK(messages->Errors == 0 && messages->Warnings == 0);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(std::isnan(filter->GetMean(ToResult)) && std::isnan(filter->GetReferenceDiagonal()));

  filter->SetNumberOfSamples(1);
  CHECK(filter->GetNumberOfSamples() == filter->GetNumberOfSamplesMinValue());
  filter->SetSeed(-1);
  CHECK(filter->GetSeed() == 0);
  CHECK(std::isnan(filter->GetMaximum(2)));
  return EXIT_SUCCESS;
}

/** Aborts the run at the first progress. */
class Aborter : public vtkCommand
{
public:
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void* callData) override
  {
    const double progress = *static_cast<double*>(callData);
    this->Rising = this->Rising && progress >= this->Last;
    this->Last = progress;
    if (progress > 0.0 && this->Armed)
    {
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
  }
  bool Armed = true;
  bool Rising = true;
  double Last = 0.0;
};

int CheckAbortAndProgress()
{
  const auto mesh = Rectangle(1, 1, 0);
  vtkNew<vtkNeuralMeshComparison> filter;
  vtkNew<Aborter> aborter;
  filter->AddObserver(vtkCommand::ProgressEvent, aborter);
  Prepare(filter, mesh, mesh);
  filter->Update();
  CHECK(std::isnan(filter->GetMean(ToResult)));
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);

  // The next run starts clean.
  aborter->Armed = false;
  aborter->Last = 0.0;
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  CHECK(IsNear(filter->GetMean(ToResult), 0.0, 1e-12));
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 4);
  CHECK(aborter->Rising && aborter->Last == 1.0);
  return EXIT_SUCCESS;
}
}

int TestNeuralMeshComparison(int, char*[])
{
  CHECK(CheckSpheres() == EXIT_SUCCESS);
  CHECK(CheckShiftedAndTilted() == EXIT_SUCCESS);
  CHECK(CheckAsymmetric() == EXIT_SUCCESS);
  CHECK(CheckMeasures() == EXIT_SUCCESS);
  CHECK(CheckMaximumInsideTriangles() == EXIT_SUCCESS);
  CHECK(CheckSeed() == EXIT_SUCCESS);
  CHECK(CheckEquallyNear() == EXIT_SUCCESS);
  CHECK(CheckAgainstHausdorff() == EXIT_SUCCESS);
  CHECK(CheckOffsetAndScale() == EXIT_SUCCESS);
  CHECK(CheckUncleanInput() == EXIT_SUCCESS);
  CHECK(CheckStrips() == EXIT_SUCCESS);
  CHECK(CheckErrors() == EXIT_SUCCESS);
  CHECK(CheckAbortAndProgress() == EXIT_SUCCESS);
  return EXIT_SUCCESS;
}
