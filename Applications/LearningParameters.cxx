// SPDX-License-Identifier: BSD-3-Clause
#include "LearningParameters.h"

#include "base/OneLine.h"
#include "NearestNames.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshParameters.h"

#include "vtkNew.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <type_traits>
#include <utility>

namespace
{
// Of the columns of the table.
constexpr int NameWidth = 25;
constexpr int DefaultWidth = 7;
constexpr int RangeWidth = 18;

using Words = std::vector<std::string>;

/** A switch is on or off. */
const Words& WordsOfSwitch()
{
  static const Words words{ "off", "on" };
  return words;
}

/** In full, unless a number has more digits than anybody wants to see. */
template <typename ValueT>
std::string Shown(ValueT value)
{
  if constexpr (std::is_integral_v<ValueT>)
  {
    return std::to_string(value);
  }
  constexpr int DigitsOfFraction = 4, DigitsOfWhole = 15;
  std::ostringstream text;
  text << std::setprecision(value == std::floor(value) ? DigitsOfWhole : DigitsOfFraction) << value;
  return text.str();
}

std::string Alternatives(const Words& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : " or ") + word;
  }
  return text;
}

/** All of a text as a number; nothing if it is none. */
template <typename NumberT>
std::optional<NumberT> Parsed(const std::string& text)
{
  NumberT value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size();
  return isNumber ? std::optional(value) : std::nullopt;
}

/** The value that a text stands for, if it is one of the type. */
template <typename ValueT>
std::optional<ValueT> ValueOf(const std::string& text, const Words& words)
{
  const auto word = std::find(words.begin(), words.end(), text);
  if (word != words.end())
  {
    return static_cast<ValueT>(word - words.begin());
  }
  if (words == WordsOfSwitch() && (text == "true" || text == "false"))
  {
    return static_cast<ValueT>(text == "true");
  }
  if constexpr (std::is_integral_v<ValueT>)
  {
    if (const auto whole = Parsed<ValueT>(text))
    {
      return whole;
    }
    // 1e6 is as good as 1000000, as long as a double has all of its digits.
    constexpr double MostExact = 9007199254740992.0;
    const double number = Parsed<double>(text).value_or(0.5);
    const bool isExact = number == std::floor(number) && std::abs(number) <= MostExact;
    const auto whole = isExact ? static_cast<long long>(number) : 0;
    return isExact && std::in_range<ValueT>(whole) ? std::optional(static_cast<ValueT>(whole))
                                                   : std::nullopt;
  }
  return Parsed<ValueT>(text);
}

/** `texts` are a description, and words for the values from 0 on. */
template <typename OwnerT, typename ValueT>
LearningParameter Describe(const char* name, const std::vector<std::string>& texts,
  std::type_identity_t<ValueT> minimum, std::type_identity_t<ValueT> maximum, ValueT defaultValue,
  void (OwnerT::*set)(ValueT))
{
  const Words words(texts.begin() + 1, texts.end());
  const std::string ends = Shown(minimum) + " to " + Shown(maximum);
  const std::string range = words.empty()
    ? (std::is_integral_v<ValueT> ? "an integer from " : "a number from ") + ends
    : Alternatives(words);
  const auto setValue = [=](vtkNeuralMesh* filter, const std::string& text)
  {
    const std::optional<ValueT> value = ValueOf<ValueT>(text, words);
    if (!value || !(*value >= minimum && *value <= maximum))
    {
      throw UsageError("--set " + std::string(name) + "=" + neuralmesh::oneLine(text) + ": " +
        name + " must be " + range);
    }
    auto* owner = dynamic_cast<OwnerT*>(filter);
    if (!owner)
    {
      throw UsageError(std::string("--set ") + name + " goes with --ensemble");
    }
    (owner->*set)(*value);
  };
  // Where the range ends with the type, nobody wants to see the digits.
  const bool isOpen =
    std::is_same_v<ValueT, vtkIdType> && maximum == std::numeric_limits<ValueT>::max();
  return { name, texts.front(),
    words.empty() ? Shown(defaultValue) : words.at(static_cast<std::size_t>(defaultValue)),
    !words.empty() ? range
      : isOpen     ? "from " + Shown(minimum) + " on"
                   : ends,
    words, setValue };
}

std::vector<LearningParameter> MakeParameters()
{
  vtkNew<vtkNeuralMeshEnsemble> defaults;
#define DESCRIBE(property, minimum, maximum, ...)                                                  \
  Describe(#property, { __VA_ARGS__ }, minimum, maximum, defaults->Get##property(),                \
    &vtkNeuralMeshEnsemble::Set##property),
  return { NEURAL_MESH_FOR_EACH_SETTING(DESCRIBE) };
#undef DESCRIBE
}

/** What to say of a name that no parameter has. */
std::string DescribeUnknown(const std::string& name)
{
  std::vector<std::string> names;
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    names.push_back(parameter.Name);
  }
  std::string message = "--set: there is no parameter " + neuralmesh::oneLine(name) + "; ";
  const std::string question = DidYouMean(name, names);
  return message + question + (question.empty() ? "" : " ") +
    "'neuralmesh reconstruct --help' lists them all";
}
}

const std::vector<LearningParameter>& GetLearningParameters()
{
  static const std::vector<LearningParameter> parameters = MakeParameters();
  return parameters;
}

void SetLearningParameter(vtkNeuralMesh* filter, const std::string& assignment)
{
  const std::size_t equals = assignment.find('=');
  if (equals == 0 || equals == std::string::npos)
  {
    throw UsageError("--set " + assignment + ": expected NAME=VALUE");
  }
  const std::string name = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);

  const auto& parameters = GetLearningParameters();
  const auto parameter = std::find_if(parameters.begin(), parameters.end(),
    [&](const LearningParameter& candidate) { return candidate.Name == name; });
  if (parameter == parameters.end())
  {
    throw UsageError(DescribeUnknown(name));
  }
  parameter->Set(filter, text);
}

const std::string& LearningDefault(const std::string& name)
{
  const auto& parameters = GetLearningParameters();
  return std::find_if(parameters.begin(), parameters.end(),
    [&](const LearningParameter& parameter) { return parameter.Name == name; })
    ->Default;
}

std::string DescribeLearningParameters()
{
  std::ostringstream table;
  const auto write = [&](const std::string& name, const std::string& defaultValue,
                       const std::string& range, const std::string& description)
  {
    table << "  " << std::left << std::setw(NameWidth) << name << std::setw(DefaultWidth)
          << defaultValue << " " << std::setw(RangeWidth - 1) << range << description << "\n";
  };
  write("name", "default", "range", "what it is");
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    if (parameter.Words.empty() || parameter.Words == WordsOfSwitch())
    {
      write(parameter.Name, parameter.Default, parameter.Range + " ", parameter.Description);
    }
    else
    {
      table << "  " << std::left << std::setw(NameWidth) << parameter.Name << parameter.Description
            << ": " << parameter.Range << "; " << parameter.Default << " by default\n";
    }
  }
  return table.str();
}
