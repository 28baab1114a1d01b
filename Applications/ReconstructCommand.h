// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReconstructCommand_h
#define ReconstructCommand_h

#include <functional>

namespace CLI
{
class App;
}

/**
 * Adds `reconstruct INPUT OUTPUT` to the command line. What is returned carries it out, after the
 * line was parsed, and gives the exit status; it throws UsageError or std::runtime_error.
 */
std::function<int()> AddReconstructCommand(CLI::App& application);

#endif
