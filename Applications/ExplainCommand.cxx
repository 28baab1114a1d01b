// SPDX-License-Identifier: BSD-3-Clause
#include "ExplainCommand.h"

#include "DistinctFiles.h"
#include "ErrorCollector.h"
#include "ExplainedPoints.h"
#include "FileArguments.h"
#include "MeshReader.h"
#include "PointReader.h"
#include "PropertyOptions.h"

#include "vtkNeuralMeshExplanation.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace
{
/** More are not printed. */
constexpr vtkIdType MostPieces = 10;

struct ExplainOptions
{
  std::string Input;
  std::string Mesh;
  std::string Output;
  double SmallestPiece = 0.0;
};

void PrintPieces(vtkPolyData* points)
{
  vtkDataArray* centers = points->GetFieldData()->GetArray("MissedPieceCenters");
  vtkDataArray* counts = points->GetFieldData()->GetArray("MissedPiecePoints");
  for (vtkIdType i = 0; i < std::min(centers->GetNumberOfTuples(), MostPieces); ++i)
  {
    const double* center = centers->GetTuple3(i);
    std::printf("missed     %.0f points around (%.10g, %.10g, %.10g)\n", counts->GetTuple1(i),
      center[0], center[1], center[2]);
  }
  if (centers->GetNumberOfTuples() > MostPieces)
  {
    std::printf(
      "missed     ... in %lld places\n", static_cast<long long>(centers->GetNumberOfTuples()));
  }
}

int Explain(const ExplainOptions& options)
{
  RequireDistinctFiles(
    { { "INPUT", options.Input }, { "MESH", options.Mesh }, { "OUTPUT", options.Output, true } });
  RequireExplanationPlace("OUTPUT", options.Output);
  const auto points = ReadPoints(options.Input);
  const auto mesh = ReadMesh(options.Mesh);
  vtkNew<vtkNeuralMeshExplanation> filter;
  vtkNew<ErrorCollector> errors;
  errors->Observe(filter);
  filter->SetInputData(points);
  filter->SetMeshData(mesh);
  filter->SetSmallestPiece(options.SmallestPiece);
  filter->Update();
  if (errors->HasError())
  {
    throw std::runtime_error(options.Input + " and " + options.Mesh + ": " + errors->GetMessage());
  }
  vtkPolyData* explained = filter->GetOutput();
  if (explained->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(options.Input + ": there are no points in it");
  }
  WriteExplanation(explained, options.Output);
  std::printf("points     %lld\n", static_cast<long long>(explained->GetNumberOfPoints()));
  PrintReasons(explained);
  PrintPieces(explained);
  return 0;
}
}

std::function<int()> AddExplainCommand(CLI::App& application)
{
  auto options = std::make_shared<ExplainOptions>();
  vtkNew<vtkNeuralMeshExplanation> defaults;
  const auto smallest = NEURAL_MESH_NUMBERS(defaults, SmallestPiece);
  CLI::App* command = application.add_subcommand(
    "explain", "Measure the distance of each point from a mesh, and give the reason");
  AddPoints(command, options->Input);
  AddFile(command, "MESH", options->Mesh,
    "A mesh of any program, in the same coordinates: .ply .vtp .vtk .obj .stl .off");
  AddFile(command, "OUTPUT", options->Output, "The points with Distance and Reason: .vtp");
  AddNumber(command, "--keep-pieces", options->SmallestPiece, smallest,
    "Part of all points below which missed points are a small piece, " + Described(smallest),
    "PART");
  command->footer(
    "A point is away from the mesh if its distance exceeds two limits: three times its mean\n"
    "distance to its six nearest neighbours, and eight times the median distance of all points.\n"
    "Reason is 0 (explained: not away), 1 (outlier: away, and apart from other points), 2 (small\n"
    "piece: away, with few others), 3 (unreachable: away, with many others) or 4 (dropped: no\n"
    "finite coordinates, or one of very many points at one place).\n"
    "\nExit status: 0 done, 1 failed (the message is on stderr), 2 wrong use.");
  return [options] { return Explain(*options); };
}
