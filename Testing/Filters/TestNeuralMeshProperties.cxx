// SPDX-License-Identifier: BSD-3-Clause
// Promise: values out of range are clamped, a preset sets all that it should, an unchanged value
// makes nothing execute anew, and PrintSelf prints every property.
#include "FilterTesting.h"

#include "vtkNeuralMesh.h"

#include <sstream>

int TestNeuralMeshProperties(int, char*[])
{
  vtkNew<vtkNeuralMesh> filter;
  CHECK(filter->GetNumberOfVertices() == 20000);
  CHECK(filter->GetSeed() == 1);
  CHECK(filter->GetVariant() == vtkNeuralMesh::NOISE_FILTERING);
  CHECK(filter->GetPreset() == vtkNeuralMesh::DEFAULT);
  CHECK(std::string(filter->GetStopReason()) == "none");

  filter->SetNumberOfVertices(1);
  CHECK(filter->GetNumberOfVertices() == 4);
  filter->SetSeed(-5);
  CHECK(filter->GetSeed() == 0);
  filter->SetWinnerRate(2.0);
  CHECK(filter->GetWinnerRate() == 1.0);
  filter->SetSmoothingRate(-1.0);
  CHECK(filter->GetSmoothingRate() == 0.0);
  filter->SetTargetCloudDistance(7.0);
  CHECK(filter->GetTargetCloudDistance() == 1.0);

  // The thesis: table of chapter 13, and none of what it lacks.
  filter->SetVariantToNoiseFiltering();
  filter->SetPresetToThesis();
  CHECK(filter->GetWinnerRate() == 0.1 && filter->GetNoiseTolerance() == 1.0);
  CHECK(filter->GetCounterHalfLife() == 6.0 && filter->GetSmoothingRate() == 0.05);
  CHECK(filter->GetSmoothingIterations() == 1 && filter->GetSamplesPerAddition() == 50);
  CHECK(filter->GetAdditionsPerRemoval() == 125 && filter->GetRemovalPatience() == 10.0);
  CHECK(filter->GetEdgeFlips() == 0 && filter->GetOutlierLimit() == 0.0);
  CHECK(filter->GetEarlyPatience() == 1.0 && filter->GetBatchSize() == 1);
  CHECK(filter->GetRemovalLimit() == 0.0);
  filter->SetVariantToBasic();
  filter->SetPresetToThesis();
  CHECK(filter->GetSmoothingIterations() == 5 && filter->GetCounterDecay() == 0.95);
  filter->SetOrderToList();
  filter->SetPresetToThesis();
  CHECK(filter->GetSmoothingIterations() == 1 && filter->GetSmoothingRate() == 0.2);
  CHECK(filter->GetJumpFraction() == 1.0 / 3.0 && filter->GetListVertices() == 1000);
  filter->SetPresetToDefault();
  vtkNew<vtkNeuralMesh> fresh;
  CHECK(filter->GetSmoothingRate() == fresh->GetSmoothingRate());
  CHECK(filter->GetBatchSize() == fresh->GetBatchSize());
  CHECK(filter->GetWinnerRate() == fresh->GetWinnerRate());

  const vtkMTimeType before = filter->GetMTime();
  filter->SetSeed(filter->GetSeed());
  filter->SetPreset(filter->GetPreset());
  CHECK(filter->GetMTime() == before);

  std::ostringstream text;
  filter->Print(text);
  for (const char* property :
    { "NumberOfVertices", "Seed", "Variant", "Order", "Preset", "JumpFraction", "ListVertices",
      "WinnerRate", "SmoothingRate", "SmoothingIterations", "CounterDecay", "CounterHalfLife",
      "NoiseTolerance", "NoiseWindow", "OutlierLimit", "OutlierLimitVertices", "SamplesPerAddition",
      "EarlyPatience", "EarlyVertices", "AdditionsPerRemoval", "RemovalPatience", "RemovalLimit",
      "EdgeFlips", "BatchSize", "MaximumIterations", "TargetSampleDistance", "TargetCloudDistance",
      "TimeLimit", "StallPatience", "Automatic", "NumberOfThreads", "OutputPointsPrecision",
      "GrowthAsTime", "NumberOfSnapshots", "CheckpointFileName", "CheckpointInterval",
      "KeepCheckpoint", "ResumedIterations", "PointFileName", "MaximumPoints", "StopReason" })
  {
    CHECK(text.str().find(std::string(property) + ": ") != std::string::npos);
  }
  return EXIT_SUCCESS;
}
