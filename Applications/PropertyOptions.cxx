// SPDX-License-Identifier: BSD-3-Clause
#include "PropertyOptions.h"

#include "LearningParameters.h"

#include <algorithm>

namespace
{
const PropertyWord* Find(const std::string& word, const std::vector<PropertyWord>& words)
{
  const auto place = std::find_if(words.begin(), words.end(),
    [&](const PropertyWord& candidate) { return candidate.Word == word; });
  return place == words.end() ? nullptr : &*place;
}
}

std::string Joined(const std::vector<PropertyWord>& words)
{
  std::string names;
  for (const PropertyWord& word : words)
  {
    names += (names.empty() ? "" : "|") + word.Word;
  }
  return names;
}

int ValueOf(
  const std::string& option, const std::string& word, const std::vector<PropertyWord>& words)
{
  const PropertyWord* const found = Find(word, words);
  if (!found)
  {
    throw UsageError(option + ": " + word + " is none of " + Joined(words));
  }
  return found->Value;
}

const std::string& WordOf(const std::vector<PropertyWord>& words, int value)
{
  return std::find_if(words.begin(), words.end(),
    [value](const PropertyWord& candidate) { return candidate.Value == value; })
    ->Word;
}

std::string Described(const std::vector<PropertyWord>& words, int defaultValue)
{
  std::string text;
  for (const PropertyWord& word : words)
  {
    text += (text.empty() ? "" : "; ") + word.Word;
    // A word may say it itself.
    text += word.Value == defaultValue && word.Word != "default" ? " (default)" : "";
    text += word.Text.empty() ? "" : ": " + word.Text;
  }
  return text;
}

CLI::Option* AddChoice(CLI::App* command, const std::string& name, int& value,
  const std::vector<PropertyWord>& words, const std::string& description)
{
  const auto toNumber = [words](std::string& word) -> std::string
  {
    const PropertyWord* const found = Find(word, words);
    if (!found)
    {
      return word + " is none of " + Joined(words);
    }
    word = std::to_string(found->Value);
    return {};
  };
  return command->add_option(name, value, description)
    ->transform(CLI::Validator(toNumber, ""))
    ->type_name(Joined(words));
}
