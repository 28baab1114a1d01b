// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructCommand.h"

#include "base/AtomicFile.h"
#include "ErrorCollector.h"
#include "FileExtension.h"
#include "Interruption.h"
#include "LearningParameters.h"
#include "MeshReader.h"
#include "MeshShift.h"
#include "MeshWriter.h"
#include "OrientationOptions.h"
#include "PointReader.h"
#include "ProgressBar.h"
#include "RunEstimate.h"
#include "TableWriter.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshFileSampler.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string_view>

namespace
{
/// What shells give for a process that Ctrl-C has ended.
constexpr int InterruptedStatus = 128 + SIGINT;

/// Off, or with an ensemble on.
constexpr int DefaultTopology = -1;

struct ReconstructOptions
{
  std::string Input;
  std::string Output;
  std::string Initial;
  bool InPlace = false;
  int Raw = vtkNeuralMeshFileSampler::BY_EXTENSION;
  long long Skip = 0;
  long long Vertices = 20000;
  int Seed = 1;
  int Variant = vtkNeuralMesh::NOISE_FILTERING;
  int Order = vtkNeuralMesh::EXACT;
  int Topology = DefaultTopology;
  int Boundaries = vtkNeuralMesh::KEEP;
  int Members = 0; ///< of an ensemble; 0 for none
  std::string Jump;
  std::string Weights;
  std::string Shift;
  OrientationOptions Orientation;
  bool Features = false;
  bool Automatic = false;
  int Preset = vtkNeuralMesh::DEFAULT;
  std::vector<std::string> Assignments;
  double TimeLimit = 0.0;
  int Threads = 0;
  std::string Statistics;
  std::string Checkpoint;
  double CheckpointInterval = 60.0;
  bool DryRun = false;
  bool Quiet = false;
};

class Stopwatch
{
public:
  /** Seconds since the last call. */
  double Lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Last).count();
    this->Last = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

std::string Joined(const std::map<std::string, int>& choices)
{
  std::string names;
  for (const auto& [word, value] : choices)
  {
    names += (names.empty() ? "" : "|") + word;
  }
  return names;
}

double FieldNumber(vtkPolyData* mesh, const char* name)
{
  return mesh->GetFieldData()->GetArray(name)->GetTuple1(0);
}

long long FieldValue(vtkPolyData* mesh, const char* name)
{
  return static_cast<long long>(FieldNumber(mesh, name));
}

/** The values of Jump by their names on the command line. */
const std::map<std::string, int> Jumps{ { "constant", vtkNeuralMesh::CONSTANT },
  { "normal", vtkNeuralMesh::NORMAL_ACTIVITY }, { "area", vtkNeuralMesh::AREA_CHANGE },
  { "volume", vtkNeuralMesh::VOLUME_CHANGE }, { "weighted", vtkNeuralMesh::WEIGHTED } };

/** Carries out --jump NAME or NAME=FRACTION. */
void SetJump(vtkNeuralMesh* filter, const std::string& text)
{
  const std::string name = text.substr(0, text.find('='));
  const auto jump = Jumps.find(name);
  if (jump == Jumps.end())
  {
    throw UsageError("--jump: " + name + " is none of " + Joined(Jumps));
  }
  filter->SetJump(jump->second);
  if (name != text)
  {
    SetLearningParameter(filter, "JumpFraction" + text.substr(name.size()));
  }
}

/** Throws UsageError where options exclude each other. */
void RequireSoundParameters(vtkNeuralMesh* filter)
{
  vtkNew<ErrorCollector> errors;
  errors->Observe(filter);
  const bool areSound = filter->CheckParameters();
  filter->RemoveObserver(errors);
  if (!areSound)
  {
    throw UsageError(errors->GetMessage());
  }
}

vtkSmartPointer<vtkNeuralMesh> MakeFilter(const ReconstructOptions& options)
{
  if (options.Members == 0)
  {
    return vtkSmartPointer<vtkNeuralMesh>::New();
  }
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  ensemble->SetNumberOfMembers(options.Members);
  return ensemble;
}

void PrepareFilter(vtkNeuralMesh* filter, const ReconstructOptions& options)
{
  filter->SetNumberOfVertices(options.Vertices);
  filter->SetSeed(options.Seed);
  filter->SetVariant(options.Variant);
  filter->SetOrder(options.Order);
  if (options.Topology != DefaultTopology)
  {
    filter->SetTopologyLearning(options.Topology);
  }
  filter->SetBoundaries(options.Boundaries);
  filter->SetComputeFeatureStrength(options.Features);
  filter->SetPreset(options.Preset);
  filter->SetAutomatic(options.Automatic);
  filter->SetTimeLimit(options.TimeLimit);
  filter->SetNumberOfThreads(options.Threads);
  filter->SetWeightArrayName(options.Weights.c_str());
  options.Orientation.Apply(filter);
  if (!options.Jump.empty())
  {
    SetJump(filter, options.Jump);
  }
  for (const std::string& assignment : options.Assignments)
  {
    SetLearningParameter(filter, assignment);
  }
  RequireSoundParameters(filter);
}

void AddChoice(CLI::App* command, const std::string& name, int& choice,
  const std::map<std::string, int>& choices, const std::string& description)
{
  const std::string names = Joined(choices);
  const auto toNumber = [choices, names](std::string& word) -> std::string
  {
    const auto place = choices.find(word);
    if (place == choices.end())
    {
      return word + " is none of " + names;
    }
    word = std::to_string(place->second);
    return {};
  };
  command->add_option(name, choice, description)
    ->transform(CLI::Validator(toNumber, ""))
    ->type_name(names);
}

/** Throws if the filter could not do anything with what it was given. */
void RequireResult(
  vtkNeuralMesh* filter, const ErrorCollector& errors, const ReconstructOptions& options)
{
  if (errors.HasError())
  {
    const std::string first =
      options.Initial.empty() ? "" : " (first mesh " + options.Initial + ")";
    throw std::runtime_error(options.Input + first + ": " + errors.GetMessage());
  }
  if (filter->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(options.Input + ": there are no points in it");
  }
}

int PrintEstimate(vtkNeuralMesh* filter, vtkPointSet* points, const ReconstructOptions& options)
{
  vtkNew<ErrorCollector> errors;
  errors->Observe(filter);
  const RunEstimate estimate = EstimateRun(filter, points);
  RequireResult(filter, *errors, options);
  std::printf("points     %lld\n", static_cast<long long>(points->GetNumberOfPoints()));
  std::printf("vertices   %lld\n", options.Vertices);
  std::printf("samples    about %.3g million\n", 1e-6 * estimate.Samples);
  std::printf("memory     about %.0f MB\n", 1e-6 * estimate.Bytes);
  std::printf(
    "time       about %.2g s of learning, on this machine as it is now\n", estimate.Seconds);
  return 0;
}

void Learn(vtkNeuralMesh* filter, vtkPointSet* points, const ReconstructOptions& options)
{
  vtkNew<ErrorCollector> errors;
  errors->Observe(filter);
  vtkNew<ProgressBar> bar;
  // What the filter tells in the log is printed in the end.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_WARNING);
  if (!options.Quiet)
  {
    bar->SetNumberOfVertices(options.Vertices);
    filter->AddObserver(vtkCommand::ProgressEvent, bar);
  }
  filter->SetInputData(points);
  filter->Update();
  bar->Clear();
  RequireResult(filter, *errors, options);
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
    std::printf("checkpoint %s: the same command goes on from there\n", path.c_str());
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
  if (filter->GetAutomatic())
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
  std::printf(", %.2g %% outliers\n", 100.0 * FieldNumber(mesh, "OutlierShare"));
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

/** A sampler of the file in which it lies, if that is wanted. */
vtkSmartPointer<vtkNeuralMeshFileSampler> MakeSampler(
  const ReconstructOptions& options, vtkNeuralMesh* filter)
{
  const bool isRaw = options.Raw != vtkNeuralMeshFileSampler::BY_EXTENSION;
  if (options.Skip > 0 && !isRaw)
  {
    throw UsageError("--skip: this goes with --raw only");
  }
  if (!options.InPlace && !isRaw)
  {
    return nullptr;
  }
  auto sampler = vtkSmartPointer<vtkNeuralMeshFileSampler>::New();
  sampler->SetFileName(options.Input.c_str());
  sampler->SetFormat(options.Raw);
  sampler->SetHeaderBytes(options.Skip);
  sampler->SetSeed(options.Seed);
  sampler->SetNumberOfPoints(filter->GetUsedMaximumPoints());
  return sampler;
}

/** Throws if the file is none to sample. */
vtkSmartPointer<vtkPointSet> DrawPoints(vtkNeuralMeshFileSampler* sampler)
{
  vtkNew<ErrorCollector> errors;
  errors->Observe(sampler);
  sampler->Update();
  if (errors->HasError())
  {
    throw std::runtime_error(errors->GetMessage());
  }
  return sampler->GetOutput();
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
}

int Reconstruct(const ReconstructOptions& options)
{
  const vtkSmartPointer<vtkNeuralMesh> filter = MakeFilter(options);
  PrepareFilter(filter, options);
  RequireWritableExtension(options.Output);
  const MeshShift shift = ParseShift(options.Shift);
  if (options.Features && FileExtension(options.Output) != ".vtp")
  {
    throw UsageError("--features: " + options.Output + " must be a .vtp; no other format keeps it");
  }
  neuralmesh::requireWritablePlace(options.Output);
  if (!options.Statistics.empty())
  {
    RequireTableExtension(options.Statistics);
    neuralmesh::requireWritablePlace(options.Statistics);
  }
  if (!options.Checkpoint.empty())
  {
    neuralmesh::requireWritablePlace(options.Checkpoint);
  }

  Stopwatch stopwatch;
  const auto sampler = MakeSampler(options, filter);
  const auto points = sampler ? DrawPoints(sampler) : ReadPoints(options.Input);
  if (!options.Initial.empty())
  {
    filter->SetFirstMeshData(ReadMesh(options.Initial));
  }
  RequireWritableDigits(points, options.Vertices, shift, options.Output);
  const double reading = stopwatch.Lap();
  if (options.DryRun)
  {
    return PrintEstimate(filter, points, options);
  }

  filter->SetCheckpointFileName(options.Checkpoint.c_str());
  filter->SetCheckpointInterval(options.CheckpointInterval);
  filter->KeepCheckpointOn(); // until the mesh is written
  vtkNew<Interruption> interruption;
  filter->AddObserver(vtkCommand::ProgressEvent, interruption);
  Learn(filter, points, options);
  const double learning = stopwatch.Lap();

  vtkPolyData* mesh = filter->GetOutput();
  const auto stored = WriteMesh(mesh, options.Output, shift);
  if (!options.Statistics.empty())
  {
    WriteTable(filter->GetLearningCurve(), options.Statistics);
  }
  const double writing = stopwatch.Lap();
  const std::string_view reason = filter->GetStopReason();
  const bool isCancelled = reason == "cancelled";
  if (!isCancelled && reason != "time limit")
  {
    filter->RemoveCheckpoint();
  }

  WarnOfUnknownSides(mesh);
  if (!options.Quiet)
  {
    PrintPointCount(points, sampler, mesh);
    std::printf("vertices   %lld\n", static_cast<long long>(mesh->GetNumberOfPoints()));
    std::printf("triangles  %lld\n", static_cast<long long>(mesh->GetNumberOfPolys()));
    std::printf(
      "samples    %lld, ended by: %s\n", FieldValue(mesh, "Iterations"), filter->GetStopReason());
    if (!options.Shift.empty())
    {
      PrintShift(stored, options.Output);
    }
    PrintCheckpoint(filter);
    PrintPhases(filter, sampler);
    std::printf("time       %.2f s (reading %.2f, learning %.2f, writing %.2f)\n",
      reading + learning + writing, reading, learning, writing);
    PrintSides(mesh);
    PrintReport(mesh);
    PrintChoices(mesh);
  }
  return isCancelled ? InterruptedStatus : 0;
}
}

std::function<int()> AddReconstructCommand(CLI::App& application)
{
  auto options = std::make_shared<ReconstructOptions>();
  CLI::App* command =
    application.add_subcommand("reconstruct", "Make a triangle mesh from a point cloud");
  command
    ->add_option("INPUT", options->Input,
      "Points: .ply .vtp .vtk .vtu .obj .stl, or text: .xyz .pts .txt .csv")
    ->required()
    ->type_name("");
  command->add_option("OUTPUT", options->Output, "Mesh: .vtp .ply .obj .stl")
    ->required()
    ->type_name("");
  command
    ->add_option(
      "--vertices", options->Vertices, "Vertices of the mesh, 4 to 1000000000 (default 20000)")
    ->check(CLI::Range(4LL, 1000000000LL).description(""))
    ->type_name("N");
  command
    ->add_option("--seed", options->Seed,
      "Seed of the random numbers, from 0 on (default 1): the same seed, the same mesh")
    ->check(CLI::Range(0, VTK_INT_MAX).description(""))
    ->type_name("N");
  CLI::Option* const initial =
    command
      ->add_option("--initial", options->Initial,
        "Start from the triangles of this file: .ply .vtp .vtk .obj .stl")
      ->type_name("FILE");
  command
    ->add_option("--ensemble", options->Members,
      "Start from the average of so many coarse meshes, 1 to 255, 9 say: handles come out right")
    ->check(CLI::Range(1, 255).description(""))
    ->excludes(initial)
    ->type_name("MEMBERS");
  AddChoice(command, "--method", options->Variant,
    { { "basic", vtkNeuralMesh::BASIC }, { "noise", vtkNeuralMesh::NOISE_FILTERING },
      { "normal", vtkNeuralMesh::NORMAL_BASED } },
    "basic: every sample pulls alike; noise (default): samples that are far off pull less; normal: "
    "dense where the surface bends, sparse where it is flat");
  AddChoice(command, "--preset", options->Preset,
    { { "default", vtkNeuralMesh::DEFAULT }, { "thesis", vtkNeuralMesh::THESIS } },
    "default: what measures best; thesis: Saleem's values of 2004, and nothing that he lacks");
  AddChoice(command, "--order", options->Order,
    { { "exact", vtkNeuralMesh::EXACT }, { "list", vtkNeuralMesh::LIST } },
    "How it is known where to grow; exact (default): counters; list: the activity list");
  command
    ->add_option("--weights", options->Weights,
      "Trust the points by this point array of INPUT: weights from 0 on, of which ratios count")
    ->type_name("ARRAY");
  options->Orientation.AddTo(command);
  command
    ->add_option("--jump", options->Jump,
      "With --order list: how far winners jump; FRACTION of the vertices (default 0.3333) times 1 "
      "(constant, the default) or the change by the move over the mean change")
    ->type_name(Joined(Jumps) + "[=FRACTION]");
  AddChoice(command, "--topology", options->Topology, { { "off", 0 }, { "on", 1 } },
    "on: learn handles and openings (default with --ensemble); off (default without): the surface "
    "keeps the topology of its start");
  AddShiftOption(command, options->Shift);
  AddChoice(command, "--boundaries", options->Boundaries,
    { { "keep", vtkNeuralMesh::KEEP }, { "close", vtkNeuralMesh::CLOSE } },
    "Gaps in the scan; keep (default): the mesh ends where the data ends; close: it is watertight");
  command->add_option("--set", options->Assignments, "Set a parameter of learning, see below")
    ->type_name("NAME=VALUE")
    ->take_all()
    ->allow_extra_args(false);
  command->add_flag("--automatic", options->Automatic,
    "Choose FitRounds, FitSmoothness and CurvatureDensity for INPUT by some seconds of short runs");
  command->add_flag("--features", options->Features,
    "Give each vertex its FeatureStrength, high at edges and corners; OUTPUT must be .vtp");
  command
    ->add_option("--time-limit", options->TimeLimit,
      "Learn for so many seconds at most, and write the mesh learnt so far")
    ->check(CLI::Range(0.0, 1e9).description(""))
    ->type_name("SECONDS");
  command->add_flag("--in-place", options->InPlace,
    "Do not read INPUT, which may be larger than the memory, but draw as many points from it as "
    "the "
    "vertices need: binary .ply, .vtp appended raw");
  AddChoice(command, "--raw", options->Raw,
    { { "float", vtkNeuralMeshFileSampler::RAW_FLOAT },
      { "double", vtkNeuralMeshFileSampler::RAW_DOUBLE } },
    "INPUT is x y z in binary, of 4 or 8 bytes each, little-endian; drawn as with --in-place");
  command->add_option("--skip", options->Skip, "With --raw: bytes before the first point")
    ->check(CLI::Range(0LL, VTK_ID_MAX).description(""))
    ->type_name("BYTES");
  command
    ->add_option("--threads", options->Threads,
      "Work on so many threads at most; 0 (default): on as many as the machine runs at once; the "
      "mesh is the same with any number")
    ->check(CLI::Range(0, 1024).description(""))
    ->type_name("N");
  command
    ->add_option("--statistics", options->Statistics,
      "Write how the run went, step by step, to this .csv file")
    ->type_name("FILE");
  CLI::Option* const checkpoint =
    command
      ->add_option("--checkpoint", options->Checkpoint,
        "Leave the state of the run in this file while it lasts, and go on from there if it "
        "exists: "
        "the same command ends with the same bytes, however often it was killed")
      ->type_name("FILE");
  command
    ->add_option("--checkpoint-interval", options->CheckpointInterval,
      "Seconds from one checkpoint to the next, 0 to 1000000 (default 60)")
    ->check(CLI::Range(0.0, 1e6).description(""))
    ->needs(checkpoint)
    ->type_name("SECONDS");
  command->add_flag("--dry-run", options->DryRun,
    "Write nothing; print how much memory and time the run will take, roughly");
  command->add_flag("--quiet", options->Quiet, "Print nothing but errors and warnings");
  command->footer("Parameters of learning, for --set:\n" + DescribeLearningParameters() +
    "\nFor example: neuralmesh reconstruct scan.ply mesh.vtp --vertices 20000\n"
    "Ctrl-C ends the learning, and the mesh learnt so far is written.\n"
    "Exit status: 0 done, 1 failed (the message is on stderr), 2 wrong use, 130 after Ctrl-C.");
  return [options] { return Reconstruct(*options); };
}
