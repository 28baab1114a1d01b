// SPDX-License-Identifier: BSD-3-Clause
#ifndef InfoCommand_h
#define InfoCommand_h

#include <functional>

namespace CLI
{
class App;
}

/**
 * Adds `info MESH...` to the command line. What is returned carries it out, after the line was
 * parsed, and gives the exit status: 1 if one of the files cannot be used, which then a message on
 * stderr says; the others are still reported.
 */
std::function<int()> AddInfoCommand(CLI::App& application);

#endif
