// SPDX-License-Identifier: BSD-3-Clause
#include "base/FreedArrays.h"
#include "CommandLine.h"
#include "LearningParameters.h"

#include <iostream>
#include <new>

namespace
{
constexpr int Failed = 1;
constexpr int WrongUse = 2;

int Run(int argc, char* argv[])
{
  CommandLine line;
  if (argc < 2)
  {
    std::cout << line.Application.help();
    return 0;
  }
  try
  {
    line.Application.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return line.Application.exit(error) == 0 ? 0 : WrongUse;
  }
  return line.Commands.at(line.Application.get_subcommands().front())();
}
}

int main(int argc, char* argv[])
{
  neuralmesh::returnFreedArrays();
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
