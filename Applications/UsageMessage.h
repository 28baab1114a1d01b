// SPDX-License-Identifier: BSD-3-Clause
#ifndef UsageMessage_h
#define UsageMessage_h

#include <CLI/CLI.hpp>

#include <string>

/**
 * What is said of wrong use: the message of CLI11, for options that do not exist with those of like
 * names behind it; and where there is no subcommand, with the short help.
 */
std::string UsageMessage(const CLI::App* application, const CLI::Error& error);

/** What is said of a first word that is no subcommand, with those of like names; empty if it is one, or an option. */
std::string UnknownSubcommand(const CLI::App& application, const std::string& word);

#endif
