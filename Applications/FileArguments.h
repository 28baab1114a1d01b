// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileArguments_h
#define FileArguments_h

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

/** An argument that must be given and names a file. */
CLI::Option* AddFile(
  CLI::App* command, const std::string& name, std::string& path, const std::string& description);

/** The argument INPUT: a file that ReadPoints reads. */
CLI::Option* AddPoints(CLI::App* command, std::string& path);

/**
 * The arguments INPUT..., one file or several, and OUTPUT, the last one. The references must live as long as
 * the command.
 */
void AddPointsAndOutput(CLI::App* command, std::vector<std::string>& inputs, std::string& output,
  const std::string& description);

/** Throws UsageError if the last of several names is no mesh: it was meant for something else. */
void RequireSoundNames(const std::vector<std::string>& inputs, const std::string& output);

#endif
