// SPDX-License-Identifier: BSD-3-Clause
#include "TuneCommand.h"

#include "FileArguments.h"
#include "JSON.h"
#include "PointReader.h"
#include "PropertyOptions.h"

#include "base/ThreadPool.h"
#include "cloud/PointCloud.h"
#include "run/Tuning.h"
#include "vtkNeuralMesh.h"
#include "vtkNeuralMeshRun.h"
#include "vtkPointCloudCollector.h"

#include "vtkNew.h"
#include "vtkPointSet.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace
{
struct TuneOptions
{
  std::string Input;
  vtkIdType Vertices = 0;
  int Seed = 0;
  int Threads = 0;
  bool Close = false;
  bool JSON = false;
};

/** A word where there is one. */
nlohmann::ordered_json JSONOf(std::string_view parameter, double value)
{
  const std::string_view word = neuralmesh::tunedWord(parameter, value);
  return word.empty() ? nlohmann::ordered_json(value) : nlohmann::ordered_json(word);
}

std::string TextOf(std::string_view parameter, double value)
{
  const std::string_view word = neuralmesh::tunedWord(parameter, value);
  char number[32];
  std::snprintf(number, sizeof(number), "%.3g", value);
  return word.empty() ? number : std::string(word);
}

void PrintJSON(const TuneOptions& options, const neuralmesh::Tuning& tuning)
{
  nlohmann::ordered_json chosen = nlohmann::ordered_json::object();
  for (const auto& choice : tuning.choices)
  {
    chosen[std::string(choice.parameter)] = JSONOf(choice.parameter, choice.value);
  }
  nlohmann::ordered_json trials = nlohmann::ordered_json::array();
  for (const auto& trial : tuning.trials)
  {
    trials.push_back(
      { { "parameter", trial.parameter }, { "before", JSONOf(trial.parameter, trial.before) },
        { "value", JSONOf(trial.parameter, trial.value) }, { "error", trial.error },
        { "gain", trial.gain }, { "standard_error", trial.doubt }, { "taken", trial.isTaken } });
  }
  const nlohmann::ordered_json report{ { "file", options.Input }, { "vertices", options.Vertices },
    { "chosen", chosen }, { "trials", trials }, { "reasons", tuning.reasons() } };
  std::printf("%s\n", report.dump(2).c_str());
}

void Print(const TuneOptions& options, const neuralmesh::Tuning& tuning)
{
  std::string assignments;
  for (const auto& choice : tuning.choices)
  {
    const std::string value = TextOf(choice.parameter, choice.value);
    std::printf("%-17s %s instead of %s\n", std::string(choice.parameter).c_str(), value.c_str(),
      TextOf(choice.parameter, choice.before).c_str());
    assignments +=
      choice.parameter == "Fidelity" ? " --fidelity " + value : " --set " + choice.assignment();
  }
  if (tuning.choices.empty())
  {
    std::printf("nothing better than the defaults was found\n");
  }
  for (const std::string& reason : tuning.reasons())
  {
    std::printf("  %s\n", reason.c_str());
  }
  std::printf("neuralmesh reconstruct %s OUTPUT --vertices %lld%s%s\n", options.Input.c_str(),
    static_cast<long long>(options.Vertices), options.Close ? " --boundaries close" : "",
    assignments.c_str());
}

int Tune(const TuneOptions& options)
{
  vtkPointCloudCollector collector;
  const auto points = ReadPoints(options.Input);
  collector.Collect(points);
  const neuralmesh::ThreadPool executor(vtkNeuralMeshThreads(options.Threads));
  const neuralmesh::PointCloud cloud(collector.GetPoints(), {}, false, executor);
  if (!cloud.hasExtent())
  {
    throw std::runtime_error(options.Input +
      (collector.GetPoints().empty() ? ": there are no points in it"
          : cloud.points().empty()   ? ": no point of it is finite"
                                     : ": there are no two points apart from each other"));
  }
  neuralmesh::Parameters parameters;
  parameters.numberOfVertices = static_cast<std::uint64_t>(options.Vertices);
  parameters.seed = static_cast<std::uint64_t>(options.Seed);
  parameters.boundaries =
    options.Close ? neuralmesh::Boundaries::Close : neuralmesh::Boundaries::Keep;
  const auto tuning = neuralmesh::tune(
    cloud, parameters, [](double) { return true; }, executor);
  if (options.JSON)
  {
    PrintJSON(options, *tuning);
  }
  else
  {
    Print(options, *tuning);
  }
  return 0;
}
}

std::function<int()> AddTuneCommand(CLI::App& application)
{
  auto options = std::make_shared<TuneOptions>();
  vtkNew<vtkNeuralMesh> defaults;
  const auto vertices = NEURAL_MESH_NUMBERS(defaults, NumberOfVertices);
  const auto seed = NEURAL_MESH_NUMBERS(defaults, Seed);
  const auto threads = NEURAL_MESH_NUMBERS(defaults, NumberOfThreads);
  options->Close = defaults->GetBoundaries() == vtkNeuralMesh::CLOSE;
  CLI::App* command =
    application.add_subcommand("tune", "Choose the parameters for a point cloud, with reasons");
  AddPoints(command, options->Input);
  AddNumber(command, "--vertices", options->Vertices, vertices,
    "Vertices of the mesh, " + Described(vertices), "N");
  AddNumber(
    command, "--seed", options->Seed, seed, "Seed of the random numbers, " + Described(seed), "N");
  command->add_flag(
    "--close", options->Close, "The mesh shall be watertight, although the scan has gaps");
  AddNumber(command, "--threads", options->Threads, threads,
    "Largest number of threads, " + Described(threads) +
      "; 0: as many as the process may run at once",
    "N");
  command->add_flag("--json", options->JSON, "Print JSON");
  command->footer("Takes some seconds for a cloud of any size, and writes nothing.\n"
                  "reconstruct --automatic does the same before it learns.\n"
                  "For example: neuralmesh tune scan.ply --vertices 20000\n"
                  "Exit status: 0 done, 1 failed (the message is on stderr), 2 wrong use.");
  return [options] { return Tune(*options); };
}
