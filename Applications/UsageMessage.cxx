// SPDX-License-Identifier: BSD-3-Clause
#include "UsageMessage.h"

#include "NearestNames.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <vector>

namespace
{
using Names = std::vector<std::string>;

constexpr std::string_view Dashes = "--";

/** Of so many letters at the beginning. */
bool BeginsLike(const std::string& name, const std::string& word)
{
  const std::size_t letters = std::max(Dashes.size() + 3, word.size() * 2 / 3);
  return name.compare(0, letters, word, 0, letters) == 0;
}

/** "--vertexes: did you mean --vertices?"; empty if no option has a name like that. */
std::string HintOfOption(const std::string& word, const CLI::App& command)
{
  const std::string mistyped = word.substr(0, word.find('='));
  Names names, alike;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      names.push_back(std::string(Dashes) + name);
    }
  }
  std::copy_if(names.begin(), names.end(), std::back_inserter(alike),
    [&](const std::string& name) { return BeginsLike(name, mistyped); });
  std::string question = DidYouMean(mistyped, names);
  if (question.empty() && alike.size() == 1)
  {
    question = "did you mean " + alike.front() + "?";
  }
  return question.empty() ? "" : mistyped + ": " + question + "\n";
}

std::string HintsOfOptions(const CLI::App& application)
{
  const auto parsed = application.get_subcommands();
  const CLI::App& command = parsed.empty() ? application : *parsed.front();
  std::string hints;
  Names words = application.remaining(true);
  std::sort(words.begin(), words.end());
  for (const std::string& word : words)
  {
    hints += word.starts_with(Dashes) ? HintOfOption(word, command) : "";
  }
  return hints;
}

bool IsSubcommand(const CLI::App& application, const std::string& word)
{
  const auto all = application.get_subcommands([](const CLI::App*) { return true; });
  return std::any_of(all.begin(), all.end(),
    [&](const CLI::App* subcommand) { return subcommand->get_name() == word; });
}
}

std::string UsageMessage(const CLI::App* application, const CLI::Error& error)
{
  if (dynamic_cast<const CLI::ExtrasError*>(&error))
  {
    return error.what() + ("\n" + HintsOfOptions(*application)) +
      "Run with --help for more information.\n";
  }
  if (dynamic_cast<const CLI::RequiredError*>(&error) && application->get_subcommands().empty())
  {
    return error.what() + ("\n\n" + application->help());
  }
  return CLI::FailureMessage::simple(application, error);
}

std::string UnknownSubcommand(const CLI::App& application, const std::string& word)
{
  if (word.starts_with('-') || IsSubcommand(application, word))
  {
    return "";
  }
  if (word == "batch" || word == "paraview")
  {
    return word + ": the Python package has this subcommand: use python3 -m neuralmesh " + word +
      " ..., as Documentation/Guide/CommandLine.md shows\n";
  }
  Names names;
  for (const CLI::App* subcommand :
    application.get_subcommands([](const CLI::App*) { return true; }))
  {
    names.push_back(subcommand->get_name());
  }
  const std::string question = DidYouMean(word, names);
  return "no such subcommand: " + word + "\n" +
    (question.empty() ? "" : word + ": " + question + "\n") + "\n" + application.help();
}
