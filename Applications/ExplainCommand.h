// SPDX-License-Identifier: BSD-3-Clause
#ifndef ExplainCommand_h
#define ExplainCommand_h

#include <functional>

namespace CLI
{
class App;
}

/**
 * Adds the subcommand `explain`, which writes the points of a cloud with their distances to any mesh,
 * and with reasons. Returns what runs it, and that returns the exit status. It throws
 * std::runtime_error with a message that names the files if something is wrong with them.
 */
std::function<int()> AddExplainCommand(CLI::App& application);

#endif
