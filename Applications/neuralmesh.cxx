// SPDX-License-Identifier: BSD-3-Clause
#include "LearningParameters.h"
#include "ReconstructCommand.h"

#include <CLI/CLI.hpp>

#include <iostream>

namespace
{
constexpr int Failed = 1;
constexpr int WrongUse = 2;

int Run(int argc, char* argv[])
{
  CLI::App application("Triangle meshes from point clouds, by learning", "neuralmesh");
  application.set_version_flag("--version", NEURALMESH_VERSION);
  application.require_subcommand(1);
  const auto reconstruct = AddReconstructCommand(application);
  try
  {
    application.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return application.exit(error) == 0 ? 0 : WrongUse;
  }
  return reconstruct();
}
}

int main(int argc, char* argv[])
{
  try
  {
    return Run(argc, argv);
  }
  catch (const UsageError& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
    return WrongUse;
  }
  catch (const std::exception& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
    return Failed;
  }
}
