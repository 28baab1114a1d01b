// SPDX-License-Identifier: BSD-3-Clause
#include "FileArguments.h"

CLI::Option* AddFile(
  CLI::App* command, const std::string& name, std::string& path, const std::string& description)
{
  return command->add_option(name, path, description)->required()->type_name("");
}

CLI::Option* AddPoints(CLI::App* command, std::string& path)
{
  return AddFile(
    command, "INPUT", path, "Points: .ply .vtp .vtk .vtu .obj .stl, or text: .xyz .pts .txt .csv");
}
