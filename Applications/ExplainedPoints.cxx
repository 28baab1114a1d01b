// SPDX-License-Identifier: BSD-3-Clause
#include "ExplainedPoints.h"

#include "base/AtomicFile.h"
#include "FileExtension.h"
#include "LearningParameters.h"
#include "MeshWriter.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"

#include <cstdio>

void RequireExplanationPlace(const std::string& option, const std::string& path)
{
  if (FileExtension(path) != ".vtp")
  {
    throw UsageError(option + ": " + path + " must be a .vtp; no other format keeps it");
  }
  neuralmesh::requireWritablePlace(path);
}

void WriteExplanation(vtkPolyData* points, const std::string& path) { WriteMesh(points, path); }

void PrintReasons(vtkPolyData* data)
{
  const auto count = [data](const char* name)
  { return static_cast<long long>(data->GetFieldData()->GetArray(name)->GetTuple1(0)); };
  const double share = data->GetFieldData()->GetArray("UnexplainedShare")->GetTuple1(0);
  std::printf(
    "left out   %lld outliers, %lld in small pieces, %lld unreachable: %.2g %% unexplained\n",
    count("OutlierPoints"), count("SmallPiecePoints"), count("UnreachablePoints"), 100.0 * share);
}
