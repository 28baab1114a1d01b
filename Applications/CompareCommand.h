// SPDX-License-Identifier: BSD-3-Clause
#ifndef CompareCommand_h
#define CompareCommand_h

#include <functional>

namespace CLI
{
class App;
}

/**
 * Adds `compare REFERENCE RESULT` to the command line. What is returned carries it out, after the
 * line was parsed, and gives the exit status; it throws std::runtime_error.
 */
std::function<int()> AddCompareCommand(CLI::App& application);

#endif
