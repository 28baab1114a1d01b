// SPDX-License-Identifier: BSD-3-Clause
#include "CompareCommand.h"
#include "InfoCommand.h"
#include "LearningParameters.h"
#include "ReconstructCommand.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <iostream>
#include <map>
#include <new>

namespace
{
constexpr int Failed = 1;
constexpr int WrongUse = 2;

int Run(int argc, char* argv[])
{
  CLI::App application("Triangle meshes from point clouds, by learning", "neuralmesh");
  application.set_version_flag("--version", NEURALMESH_VERSION);
  application.require_subcommand(1);
  std::map<CLI::App*, std::function<int()>> commands;
  for (const auto& add : { AddReconstructCommand, AddCompareCommand, AddInfoCommand })
  {
    // The newest subcommand is the last one.
    const auto run = add(application);
    commands[application.get_subcommands({}).back()] = run;
  }
  try
  {
    application.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return application.exit(error) == 0 ? 0 : WrongUse;
  }
  return commands.at(application.get_subcommands().front())();
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
  catch (const std::bad_alloc&)
  {
    std::cerr << "neuralmesh: there is not enough memory; --dry-run tells how much it takes, "
                 "and --in-place reads no more of a file than it needs"
              << std::endl;
    return Failed;
  }
  catch (const std::exception& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
    return Failed;
  }
}
