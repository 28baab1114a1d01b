// SPDX-License-Identifier: BSD-3-Clause
#include "ReconstructCommand.h"

#include "base/AtomicFile.h"
#include "DistinctFiles.h"
#include "ErrorCollector.h"
#include "ExplainedPoints.h"
#include "FeatureLines.h"
#include "FileArguments.h"
#include "FileExtension.h"
#include "Interruption.h"
#include "LearningParameters.h"
#include "LevelFiles.h"
#include "MeshReader.h"
#include "MeshShift.h"
#include "MeshWriter.h"
#include "OrientationOptions.h"
#include "PointInputs.h"
#include "ProgressBar.h"
#include "PropertyOptions.h"
#include "RunEstimate.h"
#include "RunReport.h"
#include "SizeOptions.h"
#include "Stopwatch.h"
#include "SurfaceInputs.h"
#include "TableWriter.h"

#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshFileSampler.h"

#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdio>
#include <memory>
#include <new>
#include <string_view>

namespace
{
/// With --strict, if there was a warning.
constexpr int WarnedStatus = 3;

/// That of the filter: with an ensemble it is another one.
constexpr int DefaultTopology = -1;

/** What is typed. Properties have the defaults of their options. */
struct ReconstructOptions
{
  std::vector<std::string> Inputs;
  std::string Output;
  std::string Initial;
  bool InPlace = false;
  int Raw = vtkNeuralMeshFileSampler::BY_EXTENSION;
  long long Skip = 0;
  SizeOptions Size;
  int Seed = 0;
  int Variant = 0;
  int Order = 0;
  int Topology = DefaultTopology;
  int Boundaries = 0;
  double CloseHolesBelow = 0.0;
  int Fidelity = 0;
  double KeepPieces = 0.0;
  int Members = 0; ///< of an ensemble; 0 for none
  std::string Jump;
  std::string Weights;
  std::string Shift;
  OrientationOptions Orientation;
  bool Features = false;
  bool Uncertainty = false;
  bool Automatic = false;
  bool Remesh = false;
  int Preset = 0;
  std::vector<std::string> Assignments;
  double TimeLimit = 0.0;
  int Threads = 0;
  std::string Statistics;
  std::string Explanation;
  std::string FeatureLines;
  bool Strict = false;
  std::string Checkpoint;
  double CheckpointInterval = 0.0;
  bool DryRun = false;
  bool Quiet = false;
};

const std::vector<PropertyWord> Jumps{ { "constant", vtkNeuralMesh::CONSTANT, "" },
  { "normal", vtkNeuralMesh::NORMAL_ACTIVITY, "" }, { "area", vtkNeuralMesh::AREA_CHANGE, "" },
  { "volume", vtkNeuralMesh::VOLUME_CHANGE, "" }, { "weighted", vtkNeuralMesh::WEIGHTED, "" } };

/** Carries out --jump NAME or NAME=FRACTION. */
void SetJump(vtkNeuralMesh* filter, const std::string& text)
{
  const std::string name = text.substr(0, text.find('='));
  filter->SetJump(ValueOf("--jump", name, Jumps));
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
  options.Size.Apply(filter);
  filter->SetSeed(options.Seed);
  filter->SetVariant(options.Variant);
  filter->SetOrder(options.Order);
  if (options.Topology != DefaultTopology)
  {
    filter->SetTopologyLearning(options.Topology);
  }
  filter->SetBoundaries(options.Boundaries);
  filter->SetCloseHolesBelow(options.CloseHolesBelow);
  filter->SetFidelity(options.Fidelity);
  filter->SetKeepPieces(options.KeepPieces);
  filter->SetComputeFeatureStrength(options.Features);
  filter->SetComputeUncertainty(options.Uncertainty);
  filter->SetPreset(options.Preset);
  filter->SetAutomatic(options.Automatic);
  filter->SetExplainPoints(!options.Explanation.empty());
  filter->SetComputeFeatureLines(!options.FeatureLines.empty());
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

std::string NamesOf(const std::vector<std::string>& paths)
{
  std::string names = paths.front();
  for (std::size_t i = 1; i < paths.size(); ++i)
  {
    names += ", " + paths[i];
  }
  return names;
}

/** Throws if the filter could not do anything with what it was given. */
void RequireResult(
  vtkNeuralMesh* filter, const ErrorCollector& errors, const ReconstructOptions& options)
{
  if (errors.HasError())
  {
    const std::string first =
      options.Initial.empty() ? "" : " (first mesh " + options.Initial + ")";
    throw std::runtime_error(NamesOf(options.Inputs) + first + ": " + errors.GetMessage());
  }
  if (filter->GetOutput()->GetNumberOfPoints() == 0)
  {
    throw std::runtime_error(NamesOf(options.Inputs) + ": there are no points in it");
  }
}

int PrintEstimate(vtkNeuralMesh* filter, vtkPointSet* points, const ReconstructOptions& options)
{
  vtkNew<ErrorCollector> errors;
  errors->HideWarningsOfMesh(); // The trials are none of the user's.
  errors->Observe(filter);
  std::string report = neuralmesh::estimateRun(PlanRun(filter, points), {}).report(1.0);
  try
  {
    report = EstimateRun(filter, points);
    RequireResult(filter, *errors, options);
  }
  catch (const std::bad_alloc&)
  {
    // The memory is told all the same.
    report += "time       not known: there is not enough memory to try it\n";
  }
  std::printf("points     %lld\n", static_cast<long long>(points->GetNumberOfPoints()));
  std::printf("vertices   %lld\n",
    static_cast<long long>(options.Size.GetMostVertices(points->GetNumberOfPoints())));
  std::fputs(report.c_str(), stdout);
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
    bar->SetNumberOfVertices(options.Size.GetMostVertices(points->GetNumberOfPoints()));
    filter->AddObserver(vtkCommand::ProgressEvent, bar);
  }
  filter->SetInputData(points);
  filter->Update();
  bar->Clear();
  RequireResult(filter, *errors, options);
}

/** The same, and where there is not enough memory says how much it takes. */
void LearnInMemory(vtkNeuralMesh* filter, vtkPointSet* points, const ReconstructOptions& options)
{
  const double bytes = neuralmesh::estimatedBytes(PlanRun(filter, points));
  try
  {
    Learn(filter, points, options);
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error("there is not enough memory: the run takes about " +
      std::to_string(std::llround(1e-6 * bytes)) +
      " MB; fewer vertices take less, and --in-place reads no more of a file than it needs");
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
  if (options.Inputs.size() > 1)
  {
    throw UsageError(
      std::string(isRaw ? "--raw" : "--in-place") + ": this goes with one INPUT only");
  }
  auto sampler = vtkSmartPointer<vtkNeuralMeshFileSampler>::New();
  sampler->SetFileName(options.Inputs.front().c_str());
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

int Reconstruct(const ReconstructOptions& options)
{
  RequireSoundNames(options.Inputs, options.Output);
  const vtkSmartPointer<vtkNeuralMesh> filter = MakeFilter(options);
  PrepareFilter(filter, options);
  std::vector<NamedFile> files{ { "--initial", options.Initial },
    { "--views", options.Orientation.GetViewFile() } };
  for (const std::string& input : options.Inputs)
  {
    files.push_back({ "INPUT", input });
  }
  files.insert(files.end(),
    { { "OUTPUT", options.Output, true }, { "--statistics", options.Statistics, true },
      { "--explain", options.Explanation, true }, { "--feature-lines", options.FeatureLines, true },
      { "--checkpoint", options.Checkpoint, true } });
  for (const std::string& path : SmallerLevelPaths(options.Output, options.Size.GetLevels()))
  {
    files.push_back({ "--levels", path, true });
  }
  options.Size.RequireSound(filter,
    { .firstMesh = !options.Initial.empty() || options.Members > 0,
      .checkpoint = !options.Checkpoint.empty(),
      .automatic = options.Automatic },
    options.DryRun);
  if (options.Remesh)
  {
    PrepareRemeshing(filter,
      { .points = options.InPlace || options.Raw != vtkNeuralMeshFileSampler::BY_EXTENSION,
        .firstMesh = !options.Initial.empty() || options.Members > 0,
        .weights = !options.Weights.empty(),
        .sides = options.Orientation.AreGiven(),
        .size = options.Size.IsToBeFound(),
        .levels = !options.Size.GetLevels().empty(),
        .checkpoint = !options.Checkpoint.empty(),
        .automatic = options.Automatic,
        .explanation = !options.Explanation.empty(),
        .estimate = options.DryRun },
      options.Inputs);
  }
  RequireDistinctFiles(files);
  RequireWritableExtension(options.Output);
  const MeshShift shift = ParseShift(options.Shift);
  const std::string extension = FileExtension(options.Output);
  const bool keepsArrays = extension == ".vtp" || extension == ".vtk";
  for (const auto& [name, isWanted] :
    { std::pair("--features", options.Features), std::pair("--uncertainty", options.Uncertainty) })
  {
    if (isWanted && !keepsArrays)
    {
      throw UsageError(std::string(name) + ": " + options.Output +
        " must be a .vtp or .vtk; no other format keeps it");
    }
  }
  neuralmesh::requireWritablePlace(options.Output);
  if (!options.Statistics.empty())
  {
    RequireTableExtension(options.Statistics);
    neuralmesh::requireWritablePlace(options.Statistics);
  }
  if (!options.Explanation.empty())
  {
    RequireExplanationPlace("--explain", options.Explanation);
  }
  if (!options.FeatureLines.empty())
  {
    RequireFeatureLinesPlace("--feature-lines", options.FeatureLines);
  }
  if (!options.Checkpoint.empty())
  {
    neuralmesh::requireWritablePlace(options.Checkpoint);
  }

  Stopwatch stopwatch;
  const auto sampler = MakeSampler(options, filter);
  const GivenViews views{ filter->GetNumberOfViewpoints(), options.Orientation.GetViewArray() };
  const auto points = sampler ? DrawPoints(sampler)
    : options.Remesh          ? ReadSurface(options.Inputs)
                              : ReadInputs(options.Inputs, views);
  if (!options.Initial.empty())
  {
    filter->SetFirstMeshData(ReadMesh(options.Initial));
  }
  RequireWritableDigits(
    points, options.Size.GetMostVertices(points->GetNumberOfPoints()), shift, options.Output);
  RunSeconds seconds;
  seconds.Reading = stopwatch.Lap();
  if (options.DryRun)
  {
    return PrintEstimate(filter, points, options);
  }

  filter->SetCheckpointFileName(options.Checkpoint.c_str());
  filter->SetCheckpointInterval(options.CheckpointInterval);
  filter->KeepCheckpointOn(); // until the mesh is written
  vtkNew<Interruption> interruption;
  filter->AddObserver(vtkCommand::ProgressEvent, interruption);
  LearnInMemory(filter, points, options);
  seconds.Learning = stopwatch.Lap();

  vtkPolyData* mesh = filter->GetOutput();
  const auto stored = WriteMesh(mesh, options.Output, shift);
  if (!options.Statistics.empty())
  {
    WriteTable(filter->GetLearningCurve(), options.Statistics);
  }
  // A run that was ended early has explained nothing.
  if (filter->GetExplainedPoints()->GetNumberOfPoints() > 0)
  {
    WriteExplanation(filter->GetExplainedPoints(), options.Explanation);
  }
  WriteFeatureLines(filter, options.FeatureLines);
  WriteSmallerLevels(filter, options.Output, shift);
  seconds.Writing = stopwatch.Lap();
  const std::string_view reason = filter->GetStopReason();
  const bool isCancelled = reason == "cancelled";
  if (!isCancelled && reason != "time limit")
  {
    filter->RemoveCheckpoint();
  }

  if (!options.Quiet)
  {
    PrintRun(filter, points, sampler, seconds);
    PrintFeatureLines(filter);
    PrintSmallerLevels(filter, options.Output);
    if (!options.Shift.empty())
    {
      PrintShift(stored, options.Output);
    }
  }
  if (isCancelled)
  {
    return interruption->GetExitStatus();
  }
  return options.Strict && ErrorCollector::HasShownWarning() ? WarnedStatus : 0;
}
}

std::function<int()> AddReconstructCommand(CLI::App& application)
{
  auto options = std::make_shared<ReconstructOptions>();
  vtkNew<vtkNeuralMesh> defaults;
  vtkNew<vtkNeuralMeshEnsemble> ensemble;
  options->Variant = defaults->GetVariant();
  options->Order = defaults->GetOrder();
  options->Boundaries = defaults->GetBoundaries();
  options->Fidelity = defaults->GetFidelity();
  options->Preset = defaults->GetPreset();
  options->Automatic = defaults->GetAutomatic();
  options->Features = defaults->GetComputeFeatureStrength();
  options->Uncertainty = defaults->GetComputeUncertainty();
  const auto seed = NEURAL_MESH_NUMBERS(defaults, Seed);
  const auto members = NEURAL_MESH_NUMBERS(ensemble, NumberOfMembers);
  const auto seconds = NEURAL_MESH_NUMBERS(defaults, TimeLimit);
  const auto threads = NEURAL_MESH_NUMBERS(defaults, NumberOfThreads);
  const auto holes = NEURAL_MESH_NUMBERS(defaults, CloseHolesBelow);
  const auto pieces = NEURAL_MESH_NUMBERS(defaults, KeepPieces);
  const auto interval = NEURAL_MESH_NUMBERS(defaults, CheckpointInterval);
  const std::vector<PropertyWord> methods{ { "basic", vtkNeuralMesh::BASIC,
                                             "all samples move vertices alike" },
    { "noise", vtkNeuralMesh::NOISE_FILTERING, "distant samples move vertices less" },
    { "normal", vtkNeuralMesh::NORMAL_BASED,
      "dense where the surface bends, sparse where it is flat" } };
  const std::vector<PropertyWord> presets{ { "default", vtkNeuralMesh::DEFAULT,
                                             "the values with the best measured results" },
    { "thesis", vtkNeuralMesh::THESIS, "the values of Saleem's thesis, without later additions" } };
  const std::vector<PropertyWord> orders{ { "exact", vtkNeuralMesh::EXACT, "counters" },
    { "list", vtkNeuralMesh::LIST, "the activity list" } };
  const std::vector<PropertyWord> boundaries{
    { "keep", vtkNeuralMesh::KEEP, "the mesh ends where the points end" },
    { "close", vtkNeuralMesh::CLOSE, "the mesh is watertight, unless it is an almost flat sheet" }
  };
  const std::vector<PropertyWord> fidelities{ { "draft", vtkNeuralMesh::DRAFT_FIDELITY,
                                                "only the first rounds of the fit" },
    { "default", vtkNeuralMesh::DEFAULT_FIDELITY, "also creases, tips and noise" },
    { "high", vtkNeuralMesh::HIGH_FIDELITY, "more rounds, until they gain almost nothing" } };

  CLI::App* command =
    application.add_subcommand("reconstruct", "Make a triangle mesh from a point cloud");
  AddPointsAndOutput(command, options->Inputs, options->Output,
    "Mesh: .vtp .ply .obj .stl .glb .off .vtk. It must differ from all other files");
  options->Size.AddTo(command);
  AddRemeshOption(command, options->Remesh);
  AddNumber(command, "--seed", options->Seed, seed,
    "Seed of the random numbers, " + Described(seed) + ": the same seed, the same mesh", "N");
  CLI::Option* const initial =
    command
      ->add_option("--initial", options->Initial,
        "Start from the triangles of this file: .ply .vtp .vtk .obj .stl .off")
      ->type_name("FILE");
  AddNumber(command, "--ensemble", options->Members, members.Minimum, members.Maximum,
    "Number of coarse meshes whose average is the start, " +
      RangeText(members.Minimum, members.Maximum) + ", " + PlainNumber(members.Default) +
      " is usual: makes handles more reliable",
    "MEMBERS")
    ->excludes(initial);
  AddChoice(command, "--method", options->Variant, methods, Described(methods, options->Variant));
  AddChoice(command, "--preset", options->Preset, presets, Described(presets, options->Preset));
  AddChoice(command, "--order", options->Order, orders,
    "How the program measures where to grow; " + Described(orders, options->Order));
  command
    ->add_option("--weights", options->Weights,
      "Weight the points by this point array of INPUT: weights from 0 on. Only ratios count")
    ->type_name("ARRAY");
  options->Orientation.AddTo(command);
  command
    ->add_option("--jump", options->Jump,
      "With --order list: how far winners jump. FRACTION of the vertices (default " +
        LearningDefault("JumpFraction") +
        ") times 1 (constant) or the change by the move over the mean change. Default " +
        WordOf(Jumps, defaults->GetJump()))
    ->type_name(Joined(Jumps) + "[=FRACTION]");
  const std::vector<PropertyWord> topologies{ { "off", 0,
                                                "the surface keeps the topology of its start" },
    { "on", 1, "learn handles and openings" } };
  AddChoice(command, "--topology", options->Topology, topologies,
    Described(topologies, defaults->GetTopologyLearning()) + "; with --ensemble " +
      WordOf(topologies, ensemble->GetTopologyLearning()) + " by default");
  AddShiftOption(command, options->Shift);
  AddChoice(command, "--boundaries", options->Boundaries, boundaries,
    "Gaps in the scan; " + Described(boundaries, options->Boundaries));
  AddChoice(command, "--fidelity", options->Fidelity, fidelities,
    "How much work brings the mesh close to the points; " +
      Described(fidelities, options->Fidelity));
  AddNumber(command, "--close-holes-below", options->CloseHolesBelow, holes,
    "Fill holes with an outline, the sum of the edges, shorter than LENGTH, in units of INPUT; " +
      Described(holes),
    "LENGTH");
  AddNumber(command, "--keep-pieces", options->KeepPieces, pieces,
    "Drop pieces with less than this part of the area of the surface, " + Described(pieces) +
      "; 0 keeps all",
    "PART");
  command
    ->add_option("--set", options->Assignments,
      "Set a parameter of learning, see below. May be given several times")
    ->type_name("NAME=VALUE")
    ->take_all()
    // Of any number, but each behind a --set of its own; the help would tell otherwise.
    ->expected(1, CLI::detail::expected_max_vector_size - 1)
    ->allow_extra_args(false);
  command->add_flag("--automatic", options->Automatic,
    "Choose Fidelity and FitSmoothness for INPUT by short runs of some seconds");
  command->add_flag("--features", options->Features,
    "Add FeatureStrength, which is high at edges and corners. OUTPUT must be .vtp or .vtk");
  command->add_flag("--uncertainty", options->Uncertainty,
    "Add Uncertainty, the error bar of each vertex, in units of INPUT. OUTPUT must be .vtp or "
    ".vtk");
  AddNumber(command, "--time-limit", options->TimeLimit, seconds,
    "Largest time of learning in seconds, " + Described(seconds) +
      "; the mesh learnt so far is written, with a warning; 0: no limit. A run that goes on from a "
      "checkpoint and has all its vertices is finished whatever the limit",
    "SECONDS");
  command->add_flag("--in-place", options->InPlace,
    "Draw points from INPUT, which may be larger than the memory, instead of reading it. INPUT is "
    "a binary .ply or a .vtp with appended raw data");
  const std::vector<PropertyWord> formats{ { "float", vtkNeuralMeshFileSampler::RAW_FLOAT, "" },
    { "double", vtkNeuralMeshFileSampler::RAW_DOUBLE, "" } };
  AddChoice(command, "--raw", options->Raw, formats,
    "INPUT is x y z in binary, of 4 or 8 bytes each, little-endian. Draw points as with "
    "--in-place");
  AddNumber(command, "--skip", options->Skip, 0LL, static_cast<long long>(VTK_ID_MAX),
    "With --raw: bytes before the first point", "BYTES");
  AddNumber(command, "--threads", options->Threads, threads,
    "Largest number of threads, " + Described(threads) +
      "; 0: as many as the process may run at once; the mesh is the same with any number",
    "N");
  command
    ->add_option("--statistics", options->Statistics, "Write the learning curve to this .csv file")
    ->type_name("FILE");
  command
    ->add_option("--explain", options->Explanation,
      "Write the points of INPUT to this .vtp file, each with its Distance to the mesh and a "
      "Reason. This takes some seconds for millions of points")
    ->type_name("FILE");
  command
    ->add_option("--feature-lines", options->FeatureLines,
      "Write edges sharper than FeatureAngle (30 degrees) that the points confirm to this .vtp or "
      ".vtk file, as lines with corners. OUTPUT gets the array Crease")
    ->type_name("FILE");
  command->add_flag("--strict", options->Strict,
    "Exit with status 3 if there was a warning. The mesh is written in any case");
  CLI::Option* const checkpoint =
    command
      ->add_option("--checkpoint", options->Checkpoint,
        "Save the state of the run to this file, and resume from it if it exists. The mesh is the "
        "same, byte for byte, however often the command was killed")
      ->type_name("FILE");
  AddNumber(command, "--checkpoint-interval", options->CheckpointInterval, interval,
    "Seconds between two checkpoints, " + Described(interval), "SECONDS")
    ->needs(checkpoint);
  command->add_flag("--dry-run", options->DryRun,
    "Write nothing, and print estimates of the memory and the time of the run");
  command->add_flag("--quiet", options->Quiet, "Print only errors and warnings");
  command->footer("Parameters of learning, for --set:\n" + DescribeLearningParameters() +
    "\nFor example: neuralmesh reconstruct scan.ply mesh.vtp --vertices 20000\n"
    "Ctrl-C, SIGTERM or SIGHUP end the learning and write the mesh learnt so far.\nEach warning "
    "about a mesh ends with a tag in "
    "brackets: a heading of Documentation/Guide/Failures.md.\n"
    "Exit status: 0 done, 1 failed (the message is on stderr), 2 wrong use, 3 done with a "
    "warning\nand --strict, 130 after Ctrl-C, 143 after SIGTERM, 129 after SIGHUP.");
  return [options] { return Reconstruct(*options); };
}
