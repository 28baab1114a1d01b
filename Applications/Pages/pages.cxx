// SPDX-License-Identifier: BSD-3-Clause
// Writes what tells of the command line: NeuralMeshPages man_page|bash_completion|fish_completion
#include "BashCompletion.h"
#include "FishCompletion.h"
#include "ManPage.h"

#include "CommandLine.h"

#include <iostream>
#include <map>
#include <string>

int main(int argc, char* argv[])
{
  const std::map<std::string, void (*)(const CLI::App&, std::ostream&)> pages{
    { "man_page", WriteManPage },
    { "bash_completion", WriteBashCompletion },
    { "fish_completion", WriteFishCompletion },
  };
  const auto page = pages.find(argc == 2 ? argv[1] : "");
  if (page == pages.end())
  {
    std::cerr << "there is no such page" << std::endl;
    return 2;
  }
  const CommandLine line;
  page->second(line.Application, std::cout);
  return std::cout.flush() ? 0 : 1;
}
