// SPDX-License-Identifier: BSD-3-Clause
#include "FishCompletion.h"

#include "Completion.h"
#include "LearningParameters.h"

#include <CLI/CLI.hpp>

#include <ostream>

namespace
{
std::string Quoted(const std::string& text)
{
  return "'" + CLI::detail::find_and_replace(text, "'", "\\'") + "'";
}

void WriteOption(const CLI::Option& option, const std::string& condition, std::ostream& script)
{
  script << "complete -c neuralmesh -n " << condition;
  for (const std::string& name : option.get_snames())
  {
    script << " -s " << name;
  }
  for (const std::string& name : option.get_lnames())
  {
    script << " -l " << name;
  }
  const Completion completion = CompleteValue(option);
  if (completion.IsFile)
  {
    script << " -r -F";
  }
  else if (option.get_items_expected_max() > 0)
  {
    script << " -x -a " << Quoted(Join(completion.Words, " "));
  }
  script << " -d " << Quoted(option.get_description()) << "\n";
}

/** NAME=word for the parameters of --set that take words. */
void WriteParameterWords(const std::string& condition, std::ostream& script)
{
  std::vector<std::string> assignments;
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    for (const std::string& word : parameter.Words)
    {
      assignments.push_back(parameter.Name + "=" + word);
    }
  }
  script << "complete -c neuralmesh -n " << condition << " -l set -x -a "
         << Quoted(Join(assignments, " ")) << "\n";
}
}

void WriteFishCompletion(const CLI::App& application, std::ostream& script)
{
  script << "# Completion of neuralmesh for fish.\n";
  for (const CLI::Option* option : NamedOptions(application))
  {
    WriteOption(*option, "__fish_use_subcommand", script);
  }
  for (const CLI::App* command : application.get_subcommands(nullptr))
  {
    script << "complete -c neuralmesh -n __fish_use_subcommand -f -a " << command->get_name()
           << " -d " << Quoted(command->get_description()) << "\n";
    const std::string condition = "'__fish_seen_subcommand_from " + command->get_name() + "'";
    for (const CLI::Option* option : NamedOptions(*command))
    {
      WriteOption(*option, condition, script);
    }
    if (command->get_option_no_throw("--set"))
    {
      WriteParameterWords(condition, script);
    }
  }
}
