// SPDX-License-Identifier: BSD-3-Clause
#ifndef CommandLine_h
#define CommandLine_h

#include <CLI/CLI.hpp>

#include <functional>
#include <map>

/** The command line of neuralmesh, with all its subcommands. */
struct CommandLine
{
  CommandLine();

  CLI::App Application;
  std::map<const CLI::App*, std::function<int()>> Commands; ///< what carries out each of them
};

#endif
