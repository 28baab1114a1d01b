// SPDX-License-Identifier: BSD-3-Clause
#ifndef FileArguments_h
#define FileArguments_h

#include <CLI/CLI.hpp>

#include <string>

/** An argument that must be given and names a file. */
CLI::Option* AddFile(
  CLI::App* command, const std::string& name, std::string& path, const std::string& description);

/** The argument INPUT: a file that ReadPoints reads. */
CLI::Option* AddPoints(CLI::App* command, std::string& path);

#endif
