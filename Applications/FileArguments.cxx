// SPDX-License-Identifier: BSD-3-Clause
#include "FileArguments.h"

#include "LearningParameters.h"
#include "MeshWriter.h"

#include <memory>

namespace
{
const std::string PointFileFormats =
  "Points: .ply .vtp .vtk .vtu .obj .stl .off .pcd .ptx .pwn, or text: .xyz .pts .txt .csv .asc";
}

CLI::Option* AddFile(
  CLI::App* command, const std::string& name, std::string& path, const std::string& description)
{
  return command->add_option(name, path, description)->required()->type_name("");
}

CLI::Option* AddPoints(CLI::App* command, std::string& path)
{
  return AddFile(command, "INPUT", path, PointFileFormats);
}

void AddPointsAndOutput(CLI::App* command, std::vector<std::string>& inputs, std::string& output,
  const std::string& description)
{
  // The last of all names is OUTPUT. CLI11 would take it for an INPUT: it hands out what there is in
  // order.
  const auto outputOption = std::make_shared<CLI::Option*>();
  command
    ->add_option_function<std::vector<std::string>>(
      "INPUT",
      [&inputs, outputOption](const std::vector<std::string>& names)
      {
        inputs = names;
        if ((*outputOption)->count() == 0 && names.size() > 1)
        {
          (*outputOption)->add_result(names.back());
          inputs.pop_back();
        }
      },
      PointFileFormats + "; several files are one cloud")
    ->required()
    ->type_name("");
  *outputOption = AddFile(command, "OUTPUT", output, description);
}

void RequireSoundNames(const std::vector<std::string>& inputs, const std::string& output)
{
  if (inputs.size() > 1 && !IsWritable(output))
  {
    throw UsageError(output +
      ": this is the last of several files, so it is OUTPUT; but it has no extension of a mesh");
  }
}
