// SPDX-License-Identifier: BSD-3-Clause
#include "LearningParameters.h"

#include "NearestNames.h"
#include "OneLine.h"
#include "vtkNeuralMeshEnsemble.h"
#include "vtkNeuralMeshParameters.h"

#include "vtkNew.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <type_traits>

namespace
{
/// Of the column of names in the table.
constexpr int NameWidth = 25;

/** `texts` are a description, and words for the values from 0 on. */
template <typename OwnerT, typename ValueT>
LearningParameter Describe(const char* name, std::vector<std::string> texts, double minimum,
  double maximum, ValueT defaultValue, void (OwnerT::*set)(ValueT))
{
  const auto setValue = [name, set](vtkNeuralMesh* filter, double value)
  {
    auto* owner = dynamic_cast<OwnerT*>(filter);
    if (!owner)
    {
      throw UsageError(std::string("--set ") + name + " goes with --ensemble");
    }
    (owner->*set)(static_cast<ValueT>(value));
  };
  return { name, texts.front(), minimum, maximum, static_cast<double>(defaultValue),
    std::is_integral_v<ValueT>, { texts.begin() + 1, texts.end() }, setValue };
}

std::vector<LearningParameter> MakeParameters()
{
  vtkNew<vtkNeuralMeshEnsemble> defaults;
#define DESCRIBE(property, minimum, maximum, ...)                                                  \
  Describe(#property, { __VA_ARGS__ }, static_cast<double>(minimum), static_cast<double>(maximum), \
    defaults->Get##property(), &vtkNeuralMeshEnsemble::Set##property),
  return { NEURAL_MESH_FOR_EACH_SETTING(DESCRIBE) };
#undef DESCRIBE
}

std::string ShortNumber(double value)
{
  std::ostringstream text;
  text << std::setprecision(value == std::floor(value) && value < 1e7 ? 7 : 4) << value;
  return text.str();
}

/** What a parameter may be. */
std::string DescribeRange(const LearningParameter& parameter)
{
  if (parameter.Words.empty())
  {
    return (parameter.Integral ? "an integer from " : "a number from ") +
      ShortNumber(parameter.Minimum) + " to " + ShortNumber(parameter.Maximum);
  }
  std::string words;
  for (const std::string& word : parameter.Words)
  {
    words += (words.empty() ? "" : " or ") + word;
  }
  return words;
}

/** The number that `text` stands for; NaN if that is none. */
double ValueOf(const LearningParameter& parameter, const std::string& text)
{
  const auto word = std::find(parameter.Words.begin(), parameter.Words.end(), text);
  if (word != parameter.Words.end())
  {
    return static_cast<double>(word - parameter.Words.begin());
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size();
  return isNumber ? value : std::numeric_limits<double>::quiet_NaN();
}

/** What to say of a name that no parameter has. */
std::string DescribeUnknown(const std::string& name)
{
  std::vector<std::string> names;
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    names.push_back(parameter.Name);
  }
  std::string message = "--set: there is no parameter " + OneLine(name) + "; ";
  const std::vector<std::string> nearest = NearestNames(name, names);
  for (std::size_t i = 0; i < nearest.size(); ++i)
  {
    message += (i == 0 ? "did you mean " : " or ") + nearest[i];
  }
  return message + (nearest.empty() ? "" : "? ") + "'neuralmesh reconstruct --help' lists them all";
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
  const double value = ValueOf(*parameter, text);
  if (!(value >= parameter->Minimum && value <= parameter->Maximum) ||
    (parameter->Integral && value != std::floor(value)))
  {
    throw UsageError("--set " + assignment + ": " + name + " must be " + DescribeRange(*parameter));
  }
  parameter->Set(filter, value);
}

std::string DescribeLearningParameters()
{
  std::ostringstream table;
  table << "  " << std::left << std::setw(NameWidth) << "name" << std::setw(7) << "default"
        << " " << std::setw(17) << "range"
        << "what it is\n";
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    table << "  " << std::left << std::setw(NameWidth) << parameter.Name;
    if (parameter.Words.empty())
    {
      const std::string range =
        ShortNumber(parameter.Minimum) + " to " + ShortNumber(parameter.Maximum);
      table << std::setw(7) << ShortNumber(parameter.Default) << std::setw(18) << range
            << parameter.Description << "\n";
    }
    else
    {
      table << parameter.Description << ": " << DescribeRange(parameter)
            << "; the first by default\n";
    }
  }
  return table.str();
}
