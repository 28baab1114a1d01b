// SPDX-License-Identifier: BSD-3-Clause
#include "BashCompletion.h"

#include "Completion.h"
#include "LearningParameters.h"

#include <CLI/CLI.hpp>

#include <ostream>

namespace
{
// bash takes an equals sign for a word of its own, what follows it is a value. Names of files are left
// to readline.
const char* const Beginning = R"(# Completion of neuralmesh for bash.
_neuralmesh()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words= assigned=
  if [ "$word" = = ]; then
    word= assigned=yes
  elif [ "$before" = = ]; then
    before=${COMP_WORDS[COMP_CWORD - 2]} assigned=yes
  fi
  COMPREPLY=()
  case "${COMP_WORDS[1]} $before" in
)";

const char* const Middle = R"(  esac
  if [ -z "$words$assigned" ] && [[ $COMP_CWORD -eq 1 || $word == -* ]]; then
    case "${COMP_WORDS[1]}" in
)";

const char* const End = R"(    esac
  fi
  if [ -z "$words" ]; then
    compopt -o default
    return
  fi
  [[ $words != *= ]] || compopt -o nospace
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}
complete -F _neuralmesh neuralmesh
)";

/** After which options which words come; nothing where a value is up to the user. */
void WriteValues(const CLI::App& command, std::ostream& script)
{
  for (const CLI::Option* option : NamedOptions(command))
  {
    const Completion completion = CompleteValue(*option);
    if (option->get_items_expected_max() == 0 || completion.IsFile)
    {
      continue;
    }
    for (const std::string& name : DashedNames(*option))
    {
      script << "    '" << command.get_name() << " " << name << "') "
             << (completion.Words.empty() ? "return"
                                          : "words='" + Join(completion.Words, " ") + "'")
             << " ;;\n";
    }
  }
}

/** The words that parameters of --set take; the others take numbers. */
void WriteParameterWords(std::ostream& script)
{
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    if (!parameter.Words.empty())
    {
      script << "    *' " << parameter.Name << "') words='" << Join(parameter.Words, " ")
             << "' ;;\n";
    }
  }
}

std::vector<std::string> AllDashedNames(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : NamedOptions(command))
  {
    const std::vector<std::string> some = DashedNames(*option);
    names.insert(names.end(), some.begin(), some.end());
  }
  return names;
}
}

void WriteBashCompletion(const CLI::App& application, std::ostream& script)
{
  std::vector<std::string> first = AllDashedNames(application);
  script << Beginning;
  for (const CLI::App* command : application.get_subcommands(nullptr))
  {
    WriteValues(*command, script);
    first.push_back(command->get_name());
  }
  WriteParameterWords(script);
  script << Middle;
  for (const CLI::App* command : application.get_subcommands(nullptr))
  {
    script << "      " << command->get_name() << ") words='" << Join(AllDashedNames(*command), " ")
           << "' ;;\n";
  }
  script << "      *) words='" << Join(first, " ") << "' ;;\n" << End;
}
