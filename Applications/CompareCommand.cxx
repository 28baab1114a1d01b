// SPDX-License-Identifier: BSD-3-Clause
#include "CompareCommand.h"

#include "ErrorCollector.h"
#include "JSON.h"
#include "MeshReader.h"

#include "vtkNeuralMeshComparison.h"

#include "vtkExecutive.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <memory>
#include <utility>

namespace
{
using Comparison = vtkNeuralMeshComparison;

struct CompareOptions
{
  std::string Reference;
  std::string Result;
  long long Samples = 200000;
  int Seed = 1;
  bool JSON = false;
};

nlohmann::ordered_json DirectionAsJSON(Comparison* comparison, int direction)
{
  const double percent = 100.0 / comparison->GetReferenceDiagonal();
  return { { "mean", comparison->GetMean(direction) }, { "rms", comparison->GetRMS(direction) },
    { "percentile_99", comparison->GetPercentile99(direction) },
    { "maximum", comparison->GetMaximum(direction) },
    { "mean_percent", percent * comparison->GetMean(direction) },
    { "rms_percent", percent * comparison->GetRMS(direction) },
    { "percentile_99_percent", percent * comparison->GetPercentile99(direction) },
    { "maximum_percent", percent * comparison->GetMaximum(direction) },
    { "normal_angle", comparison->GetNormalAngle(direction) },
    { "normal_consistency", comparison->GetNormalConsistency(direction) },
    { "edge_mean", comparison->GetEdgeMean(direction) },
    { "edge_to_surface", comparison->GetEdgeToSurface(direction) },
    { "edge_mean_percent", percent * comparison->GetEdgeMean(direction) },
    { "edge_to_surface_percent", percent * comparison->GetEdgeToSurface(direction) },
    { "edge_length", comparison->GetEdgeLength(direction) } };
}

/// What is no number becomes null.
void PrintJSON(Comparison* comparison, const CompareOptions& options)
{
  const double percent = 100.0 / comparison->GetReferenceDiagonal();
  constexpr int tenth = Comparison::TENTH_PERCENT, half = Comparison::HALF_PERCENT;
  const nlohmann::ordered_json object{ { "reference", options.Reference },
    { "result", options.Result }, { "samples", comparison->GetNumberOfSamples() },
    { "seed", comparison->GetSeed() }, { "reference_diagonal", comparison->GetReferenceDiagonal() },
    { "reference_to_result", DirectionAsJSON(comparison, Comparison::REFERENCE_TO_RESULT) },
    { "result_to_reference", DirectionAsJSON(comparison, Comparison::RESULT_TO_REFERENCE) },
    { "hausdorff", comparison->GetHausdorffDistance() },
    { "hausdorff_percent", percent * comparison->GetHausdorffDistance() },
    { "normal_angle", comparison->GetNormalAngle() },
    { "normal_consistency", comparison->GetNormalConsistency() },
    { "chamfer", comparison->GetChamferDistance() },
    { "chamfer_percent", percent * comparison->GetChamferDistance() },
    { "chamfer_squared", comparison->GetSquaredChamferDistance() },
    { "precision_0_1", comparison->GetPrecision(tenth) },
    { "recall_0_1", comparison->GetRecall(tenth) }, { "f_score_0_1", comparison->GetFScore(tenth) },
    { "precision_0_5", comparison->GetPrecision(half) },
    { "recall_0_5", comparison->GetRecall(half) }, { "f_score_0_5", comparison->GetFScore(half) },
    { "edge_chamfer", comparison->GetEdgeChamferDistance() },
    { "edge_chamfer_percent", percent * comparison->GetEdgeChamferDistance() } };
  constexpr auto anyBytes = nlohmann::ordered_json::error_handler_t::replace;
  std::cout << object.dump(-1, ' ', false, anyBytes) << std::endl;
}

void PrintRow(const char* title, Comparison* comparison, int direction)
{
  const double percent = 100.0 / comparison->GetReferenceDiagonal();
  const double figures[] = { comparison->GetMean(direction), comparison->GetRMS(direction),
    comparison->GetPercentile99(direction), comparison->GetMaximum(direction) };
  std::printf("%-22s", title);
  for (const double figure : figures)
  {
    std::printf("  %11.5g", figure);
  }
  std::printf("  %8.2f deg\n%-22s", comparison->GetNormalAngle(direction), "");
  for (const double figure : figures)
  {
    std::printf("  %9.4f %%", percent * figure);
  }
  std::printf("\n");
}

void PrintEdgeRow(const char* title, Comparison* comparison, int direction)
{
  const double percent = 100.0 / comparison->GetReferenceDiagonal();
  const double toEdges = comparison->GetEdgeMean(direction);
  const double toSurface = comparison->GetEdgeToSurface(direction);
  std::printf("%-22s  %11.5g  %11.5g  %11.5g\n", title, comparison->GetEdgeLength(direction),
    toEdges, toSurface);
  std::printf("%-22s  %11s  %9.4f %%  %9.4f %%\n", "", "", percent * toEdges, percent * toSurface);
}

void PrintEdges(Comparison* comparison)
{
  if (comparison->GetEdgeLength(Comparison::REFERENCE_TO_RESULT) == 0.0 &&
    comparison->GetEdgeLength(Comparison::RESULT_TO_REFERENCE) == 0.0)
  {
    std::printf("\n%-22s  %11s\n", "sharp edges", "none");
    return;
  }
  std::printf("\n%-22s  %11s  %11s  %11s\n", "sharp edges", "length", "to edges", "to surface");
  PrintEdgeRow("reference to result", comparison, Comparison::REFERENCE_TO_RESULT);
  PrintEdgeRow("result to reference", comparison, Comparison::RESULT_TO_REFERENCE);
}

void PrintBothWays(Comparison* comparison)
{
  const double percent = 100.0 / comparison->GetReferenceDiagonal();
  std::printf("\n");
  for (const auto& [threshold, name] :
    { std::pair(Comparison::TENTH_PERCENT, "0.1"), std::pair(Comparison::HALF_PERCENT, "0.5") })
  {
    std::printf("F-score at %s %%: %.4f (precision %.4f, recall %.4f)\n", name,
      comparison->GetFScore(threshold), comparison->GetPrecision(threshold),
      comparison->GetRecall(threshold));
  }
  const double chamfer = comparison->GetChamferDistance();
  const double ofEdges = comparison->GetEdgeChamferDistance();
  std::printf("Chamfer distance %.5g (%.4f %%), squared %.5g, of sharp edges %.5g (%.4f %%)\n",
    chamfer, percent * chamfer, comparison->GetSquaredChamferDistance(), ofEdges,
    percent * ofEdges);
  std::printf("Normal consistency %.4f\n", comparison->GetNormalConsistency());
  const double hausdorff = comparison->GetHausdorffDistance();
  std::printf("Hausdorff distance %.5g (%.4f %%), mean angle of the normals %.2f deg\n", hausdorff,
    percent * hausdorff, comparison->GetNormalAngle());
}

void PrintTable(Comparison* comparison, const CompareOptions& options)
{
  std::printf("reference  %s\nresult     %s\n", options.Reference.c_str(), options.Result.c_str());
  std::printf("diagonal   %.6g, of the reference\n\n", comparison->GetReferenceDiagonal());
  std::printf("%-22s  %11s  %11s  %11s  %11s  %12s\n", "distance", "mean", "RMS", "99 %", "maximum",
    "normals");
  PrintRow("reference to result", comparison, Comparison::REFERENCE_TO_RESULT);
  PrintRow("result to reference", comparison, Comparison::RESULT_TO_REFERENCE);
  PrintEdges(comparison);
  PrintBothWays(comparison);
}

int Compare(const CompareOptions& options)
{
  const auto reference = ReadMesh(options.Reference);
  const auto result = ReadMesh(options.Result);
  vtkNew<Comparison> comparison;
  vtkNew<ErrorCollector> errors;
  errors->Observe(comparison);
  errors->Observe(comparison->GetExecutive());
  comparison->SetInputData(result);
  comparison->SetReferenceData(reference);
  comparison->SetNumberOfSamples(options.Samples);
  comparison->SetSeed(options.Seed);
  comparison->Update();
  if (errors->HasError())
  {
    throw std::runtime_error(
      options.Reference + " and " + options.Result + ": " + errors->GetMessage());
  }
  if (options.JSON)
  {
    PrintJSON(comparison, options);
  }
  else
  {
    PrintTable(comparison, options);
  }
  return 0;
}
}

std::function<int()> AddCompareCommand(CLI::App& application)
{
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
    application.add_subcommand("compare", "Measure the distance of a mesh from a reference");
  command
    ->add_option("REFERENCE", options->Reference, "The true surface: .ply .vtp .vtk .obj .stl .off")
    ->required();
  command->add_option("RESULT", options->Result, "The mesh to judge, in the same coordinates")
    ->required();
  vtkNew<Comparison> limits;
  command
    ->add_option("--samples", options->Samples,
      "Points drawn on each surface, " + std::to_string(limits->GetNumberOfSamplesMinValue()) +
        " to " + std::to_string(limits->GetNumberOfSamplesMaxValue()))
    ->check(CLI::Range(static_cast<long long>(limits->GetNumberOfSamplesMinValue()),
      static_cast<long long>(limits->GetNumberOfSamplesMaxValue())))
    ->capture_default_str();
  command->add_option("--seed", options->Seed, "Seed of the random numbers, from 0 on")
    ->check(CLI::Range(0, VTK_INT_MAX))
    ->capture_default_str();
  command->add_flag("--json", options->JSON, "Print a JSON object instead of the table");
  command->footer(
    "Points are drawn evenly over the area of both surfaces, and their distances to the nearest\n"
    "points of the other surface are measured. Distances from the result to the reference show\n"
    "what is superfluous in the result, those from the reference to the result show what it\n"
    "misses. The figures are mean, root mean square, the distance that 99 % do not exceed, and "
    "the\n"
    "maximum, in units of the files and in percent of the diagonal of the bounding box of the\n"
    "reference. The mean angle, 0 to 90 degrees, is that between the normals at a point and at "
    "its\n"
    "nearest point. The surfaces are not aligned.\n"
    "\n"
    "At a sharp edge a surface turns by more than 30 degrees. The figures are the length of these\n"
    "edges, and the mean distances of points on them from the sharp edges of the other surface "
    "and\n"
    "from the whole of it. They are nan without sharp edges.\n"
    "\n"
    "Figures of both directions together:\n"
    "  F-score             precision P and recall R are the parts of the result and of the\n"
    "                      reference that are nearer to the other surface than 0.1 or 0.5 %\n"
    "                      of the diagonal, the F-score is 2 P R / (P + R)\n"
    "                      (Knapitsch et al. 2017)\n"
    "  Chamfer distance    half of the sum of both means (Mescheder et al. 2019); squared: the\n"
    "                      sum of both mean squares (Fan et al. 2017); of edges: half of the\n"
    "                      sum of both means between edges (after Chen and Zhang 2021)\n"
    "  normal consistency  the mean of |n . n'| of the normals, 0 to 1 (Mescheder et al. 2019)\n"
    "  Hausdorff distance  the larger maximum\n"
    "\nExit status: 0 done, 1 failed (the message is on stderr), 2 wrong use.");
  return [options] { return Compare(*options); };
}
