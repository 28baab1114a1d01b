// SPDX-License-Identifier: BSD-3-Clause
#ifndef UsageMessage_h
#define UsageMessage_h

#include <CLI/CLI.hpp>

#include <string>

/**
 * What is said of wrong use: the message of CLI11, for options that do not exist with those of like
 * names behind it; and where there is no subcommand, with the short help and subcommands of like names.
 */
std::string UsageMessage(const CLI::App* application, const CLI::Error& error);

#endif
