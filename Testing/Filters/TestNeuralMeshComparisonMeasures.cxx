// SPDX-License-Identifier: BSD-3-Clause
// Promise: the measures of the field and of sharp edges are those of known surfaces; the table has those of each
// direction and its field data those of both, and nothing is left of them after a run without them.
#include "ComparisonTesting.h"
#include "FilterTesting.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkTable.h"

using namespace ComparisonTesting;

namespace
{
/** Two squares with a common edge, the second one upright. */
vtkNew<vtkPolyData> TwoSquares(double z)
{
  vtkNew<vtkPolyData> corner;
  corner->DeepCopy(Rectangle(1, 1, z));
  corner->GetPoints()->InsertNextPoint(1, 0, z + 1);
  corner->GetPoints()->InsertNextPoint(1, 1, z + 1);
  const std::array<vtkIdType, 4> ids{ 1, 4, 5, 2 };
  corner->InsertNextCell(VTK_QUAD, 4, ids.data());
  return corner;
}
}

int TestNeuralMeshComparisonMeasures(int, char*[])
{
  // Both corners have an edge of length 1, which are apart by the shift. It is 0.17 % of the diagonal.
  const double shift = 0.003;
  vtkNew<vtkNeuralMeshComparison> filter;
  Prepare(filter, TwoSquares(0), TwoSquares(shift));
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
