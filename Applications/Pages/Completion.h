// SPDX-License-Identifier: BSD-3-Clause
#ifndef Completion_h
#define Completion_h

#include <string>
#include <vector>

namespace CLI
{
class App;
class Option;
}

/** What may come next on a command line. */
struct Completion
{
  std::vector<std::string> Words;
  bool IsFile = false;
};

/** The values that an option takes; none for one that is a flag, or takes a number. */
Completion CompleteValue(const CLI::Option& option);

/** The options that begin with a dash. */
std::vector<const CLI::Option*> NamedOptions(const CLI::App& command);

/** Its names with their dashes. */
std::vector<std::string> DashedNames(const CLI::Option& option);

std::string Join(const std::vector<std::string>& words, const std::string& separator);

#endif
