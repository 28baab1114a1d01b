// SPDX-License-Identifier: BSD-3-Clause
#include "base/FreedArrays.h"
#include "CommandLine.h"
#include "LearningParameters.h"
#include "UsageMessage.h"

#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <string>

namespace
{
constexpr int Failed = 1;
constexpr int WrongUse = 2;

/** Whether all that was printed has come through, which a full disk tells only now. */
bool FlushOutput()
{
  std::cout.flush();
  return std::cout.good() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

/** What was done, and printed: the exit status. */
int Finish(int status)
{
  if (FlushOutput())
  {
    return status;
  }
  std::cerr << "neuralmesh: the standard output cannot be written: is the disk full?" << std::endl;
  constexpr int FirstOfSignals = 128;
  return status > FirstOfSignals || status == WrongUse ? status : Failed;
}

int Run(int argc, char* argv[])
{
  CommandLine line;
  if (argc < 2)
  {
    std::cout << line.Application.help();
    return 0;
  }
  if (const std::string unknown = UnknownSubcommand(line.Application, argv[1]); !unknown.empty())
  {
    std::cerr << unknown << std::flush;
    return WrongUse;
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
#ifdef SIGXFSZ
  // A file beyond the limit of sizes is to fail with words as any that cannot be written.
  std::signal(SIGXFSZ, SIG_IGN);
#endif
  try
  {
    return Finish(Run(argc, argv));
  }
  catch (const UsageError& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
    return WrongUse;
  }
  catch (const std::bad_alloc&)
  {
    std::cerr << "neuralmesh: there is not enough memory to read what is given; "
                 "--in-place reads no more of a file than it needs"
              << std::endl;
    return Failed;
  }
  catch (const std::exception& error)
  {
    std::cerr << "neuralmesh: " << error.what() << std::endl;
    return Failed;
  }
}
