// SPDX-License-Identifier: BSD-3-Clause
#include "RunEstimate.h"

#include "vtkNeuralMeshEnsemble.h"

#include "vtkPointSet.h"
#include "vtkTable.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace
{
/// Vertices by which a mesh grows so as to see how fast it goes.
constexpr vtkIdType TriedVertices = 5000;

/// The program without data, and what is held at the peak beyond the input itself.
constexpr double BytesOfProgram = 52e6;
constexpr double BytesPerPoint = 42.0;
constexpr double BytesPerVertex = 400.0;

/// Up to about so many vertices the mesh is in the cache. Each doubling beyond adds this part of
/// the time of a sample, averaged over the run; see the table of growth in the README.
constexpr double VerticesInCache = 32768.0;
constexpr double SlowdownPerDoubling = 0.35;

/// The rest of the vertices are those of the average mesh.
constexpr double PartLearntByEnsemble = 0.75;

double ValueAt(vtkTable* curve, vtkIdType row, const char* column)
{
  return curve->GetValueByName(row, column).ToDouble();
}
}

RunEstimate EstimateRun(vtkNeuralMesh* filter, vtkPointSet* points)
{
  const double vertices = static_cast<double>(filter->GetNumberOfVertices());
  vtkPolyData* first = filter->GetFirstMesh();
  const vtkIdType firstVertices = first ? first->GetNumberOfPoints() : 0;
  filter->SetNumberOfVertices(
    std::min(filter->GetNumberOfVertices(), firstVertices + TriedVertices));
  const double samplesForFeatures =
    filter->GetComputeFeatureStrength() ? filter->GetFeatureSamples() * vertices : 0.0;
  filter->ComputeFeatureStrengthOff();
  filter->SetInputData(points);
  const auto start = std::chrono::steady_clock::now();
  filter->Update();
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  vtkTable* curve = filter->GetLearningCurve();

  RunEstimate estimate{};
  estimate.Bytes = BytesOfProgram + 1024.0 * static_cast<double>(points->GetActualMemorySize()) +
    BytesPerPoint * static_cast<double>(points->GetNumberOfPoints()) + BytesPerVertex * vertices;
  const vtkIdType last = curve->GetNumberOfRows() - 1;
  if (last < 1)
  {
    return estimate;
  }
  // As the second half of the small mesh went, so will the rest.
  vtkIdType middle = last;
  while (middle > 0 && ValueAt(curve, middle, "Vertices") > 0.5 * ValueAt(curve, last, "Vertices"))
  {
    --middle;
  }
  const auto rise = [&](const char* column)
  { return ValueAt(curve, last, column) - ValueAt(curve, middle, column); };
  const bool isEnsemble = vtkNeuralMeshEnsemble::SafeDownCast(filter) != nullptr;
  const double left = (isEnsemble ? PartLearntByEnsemble : 1.0) *
    std::max(0.0, vertices - ValueAt(curve, last, "Vertices"));
  const double samplesLeft =
    left * rise("Iteration") / std::max(1.0, rise("Vertices")) + samplesForFeatures;
  const double slowdown =
    1.0 + SlowdownPerDoubling * std::max(0.0, std::log2(vertices / VerticesInCache));
  const double secondsLeft = samplesLeft * slowdown * rise("Seconds") / rise("Iteration");
  estimate.Samples = ValueAt(curve, last, "Iteration") + samplesLeft;
  estimate.Seconds = (isEnsemble ? seconds : ValueAt(curve, last, "Seconds")) + secondsLeft;
  return estimate;
}
