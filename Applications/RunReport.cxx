// SPDX-License-Identifier: BSD-3-Clause
#include "RunReport.h"

#include "ExplainedPoints.h"
#include "FieldNumber.h"
#include "OrientationOptions.h"
#include "SizeOptions.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshFileSampler.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

namespace
{
long long FieldValue(vtkPolyData* mesh, const char* name)
{
  return static_cast<long long>(FieldNumber(mesh, name));
}

/** Where the run went on from, and where it may go on. */
void PrintCheckpoint(vtkNeuralMesh* filter)
{
  const std::string path = filter->GetCheckpointFileName();
  if (filter->GetResumedIterations() > 0)
  {
    std::printf("resumed    at sample %lld, from %s\n",
      static_cast<long long>(filter->GetResumedIterations()), path.c_str());
  }
  std::error_code ignored;
  if (!path.empty() && std::filesystem::exists(path, ignored))
  {
    const bool isTimeOver = std::string_view(filter->GetStopReason()) == "time limit";
    std::printf("checkpoint %s: the same command goes on from there%s\n", path.c_str(),
      isTimeOver ? ", with more time" : "");
  }
}

void PrintPhases(vtkNeuralMesh* filter, vtkNeuralMeshFileSampler* sampler)
{
  const double drawing = sampler ? sampler->GetDrawingTime() : 0.0;
  const double cloud = filter->GetCloudTime(), choice = filter->GetChoiceTime();
  const double start = filter->GetStartTime();
  const double learning = filter->GetLearningTime(), finish = filter->GetFinishTime();
  std::printf("phases     %.2f CPU s (", drawing + cloud + choice + start + learning + finish);
  if (sampler)
  {
    std::printf("drawing %.2f, ", drawing);
  }
  if (choice > 0.0)
  {
    std::printf("choice %.2f, ", choice);
  }
  std::printf(
    "cloud %.2f, start %.2f, learning %.2f, finish %.2f)\n", cloud, start, learning, finish);
}

std::string Counted(long long count, const std::string& one, const std::string& several)
{
  return count == 0 ? "no " + several : std::to_string(count) + " " + (count == 1 ? one : several);
}

/** What the mesh is worth, unless the run was aborted. */
void PrintReport(vtkPolyData* mesh)
{
  if (!mesh->GetFieldData()->HasArray("Residual"))
  {
    return;
  }
  std::printf("residual   %.3g from held-out points to the mesh", FieldNumber(mesh, "Residual"));
  if (const double noise = FieldNumber(mesh, "Noise"); std::isfinite(noise))
  {
    std::printf(", noise about %.3g", noise);
  }
  if (const double shared = FieldNumber(mesh, "SharedNoise"); shared > 0.0)
  {
    std::printf(" (shared %.3g)", shared);
  }
  std::printf(", %.2g %% too far off to count\n", 100.0 * FieldNumber(mesh, "OutlierShare"));
  // A surface has no points to be left out.
  if (mesh->GetFieldData()->HasArray("UnexplainedShare"))
  {
    PrintReasons(mesh);
  }
  if (const long long rounds = FieldValue(mesh, "FitRoundsTakenBack"); rounds > 0)
  {
    std::printf("fit        %s taken back: with more of it the mesh was worse than before\n",
      Counted(rounds, "round", "rounds").c_str());
  }
  const long long genus = FieldValue(mesh, "Genus");
  const long long cutting = FieldValue(mesh, "IntersectingTriangles");
  std::printf("shape      %s, %s, %s, %s, %s\n",
    Counted(FieldValue(mesh, "Components"), "piece", "pieces").c_str(),
    genus < 0 ? "genus not defined" : Counted(genus, "handle", "handles").c_str(),
    Counted(FieldValue(mesh, "BoundaryLoops"), "boundary", "boundaries").c_str(),
    Counted(FieldValue(mesh, "FoldedEdges"), "folded edge", "folded edges").c_str(),
    cutting < 0 ? "intersections not looked for"
                : Counted(cutting, "intersecting triangle", "intersecting triangles").c_str());
  std::printf(
    "quality    %.3f of the triangles on average (1: equilateral), %.0f %% of the vertices "
    "regular\n",
    FieldNumber(mesh, "TriangleQuality"), 100.0 * FieldNumber(mesh, "RegularRatio"));
}

/** Which parameters were chosen for the cloud, if any were to be. */
void PrintChoices(vtkPolyData* mesh)
{
  auto* chosen =
    vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("ChosenParameters"));
  if (!chosen)
  {
    return;
  }
  std::string assignments;
  for (vtkIdType i = 0; i < chosen->GetNumberOfValues(); ++i)
  {
    assignments += (i == 0 ? "" : ", ") + chosen->GetValue(i);
  }
  std::printf("chosen     %s\n", assignments.empty() ? "the defaults" : assignments.c_str());
  auto* reasons =
    vtkStringArray::SafeDownCast(mesh->GetFieldData()->GetAbstractArray("ReasonsOfChoice"));
  for (vtkIdType i = 0; reasons && i < reasons->GetNumberOfValues(); ++i)
  {
    std::printf("           %s\n", reasons->GetValue(i).c_str());
  }
}

void PrintPointCount(vtkPointSet* points, vtkNeuralMeshFileSampler* sampler, vtkPolyData* mesh)
{
  const auto count = static_cast<long long>(points->GetNumberOfPoints());
  const long long dropped = FieldValue(mesh, "DroppedPoints");
  if (sampler)
  {
    std::printf("points     %lld (%lld drawn, %lld of them dropped)\n",
      static_cast<long long>(sampler->GetNumberOfFilePoints()), count, dropped);
  }
  else
  {
    std::printf("points     %lld (%lld dropped)\n", count, dropped);
  }
  if (points->GetFieldData()->HasArray("MissingReturns"))
  {
    std::printf("no return  %lld directions in which the scanner saw nothing\n",
      static_cast<long long>(
        points->GetFieldData()->GetArray("MissingReturns")->GetComponent(0, 0)));
  }
}
}

void PrintRun(vtkNeuralMesh* filter, vtkPointSet* points, vtkNeuralMeshFileSampler* sampler,
  const RunSeconds& seconds)
{
  vtkPolyData* mesh = filter->GetOutput();
  PrintPointCount(points, sampler, mesh);
  std::printf("vertices   %lld\n", static_cast<long long>(mesh->GetNumberOfPoints()));
  std::printf("triangles  %lld\n", static_cast<long long>(mesh->GetNumberOfPolys()));
  std::printf(
    "samples    %lld, ended by: %s\n", FieldValue(mesh, "Iterations"), filter->GetStopReason());
  PrintCheckpoint(filter);
  PrintPhases(filter, sampler);
  std::printf("time       %.2f s (reading %.2f, learning %.2f, writing %.2f)\n",
    seconds.Reading + seconds.Learning + seconds.Writing, seconds.Reading, seconds.Learning,
    seconds.Writing);
  PrintSides(mesh);
  PrintReport(mesh);
  PrintChoices(mesh);
  PrintSizeChoice(mesh);
}
