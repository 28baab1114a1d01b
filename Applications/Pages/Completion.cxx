// SPDX-License-Identifier: BSD-3-Clause
#include "Completion.h"

#include "LearningParameters.h"

#include <CLI/CLI.hpp>

#include <utility>

namespace
{
/** The names of --set, with the equals sign that follows. */
std::vector<std::string> Assignments()
{
  std::vector<std::string> names;
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    names.push_back(parameter.Name + "=");
  }
  return names;
}
}

Completion CompleteValue(const CLI::Option& option)
{
  const std::string type = option.get_type_name();
  if (type == "FILE")
  {
    return { {}, true };
  }
  if (type == "NAME=VALUE")
  {
    return { Assignments() };
  }
  // one|two|three, after which there may be more in brackets.
  if (type.find('|') != std::string::npos)
  {
    std::vector<std::string> words = CLI::detail::split(type.substr(0, type.find('[')), '|');
    // What stands for a number is no word.
    std::erase(words, "N");
    return { std::move(words) };
  }
  return {};
}

std::vector<const CLI::Option*> NamedOptions(const CLI::App& command)
{
  return command.get_options([](const CLI::Option* option) { return option->nonpositional(); });
}

std::vector<std::string> DashedNames(const CLI::Option& option)
{
  return CLI::detail::split(option.get_name(false, true), ',');
}

std::string Join(const std::vector<std::string>& words, const std::string& separator)
{
  return CLI::detail::join(words, separator);
}
