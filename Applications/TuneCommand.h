// SPDX-License-Identifier: BSD-3-Clause
#ifndef TuneCommand_h
#define TuneCommand_h

#include <functional>

namespace CLI
{
class App;
}

/**
 * Adds `tune INPUT` to the command line. What is returned carries it out, after the line was parsed,
 * and gives the exit status; it throws std::runtime_error.
 */
std::function<int()> AddTuneCommand(CLI::App& application);

#endif
