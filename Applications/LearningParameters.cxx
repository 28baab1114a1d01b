// SPDX-License-Identifier: BSD-3-Clause
#include "LearningParameters.h"

#include "vtkNeuralMesh.h"

#include "vtkNew.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <type_traits>

namespace
{
template <typename ValueT>
LearningParameter Describe(const char* name, double minimum, double maximum, ValueT defaultValue,
  void (vtkNeuralMesh::*set)(ValueT))
{
  const auto setValue = [set](vtkNeuralMesh* filter, double value)
  { (filter->*set)(static_cast<ValueT>(value)); };
  return { name, minimum, maximum, static_cast<double>(defaultValue), std::is_integral_v<ValueT>,
    setValue };
}

std::vector<LearningParameter> MakeParameters()
{
  vtkNew<vtkNeuralMesh> defaults;
#define PARAMETER_IN(property, minimum, maximum)                                                   \
  Describe(#property, static_cast<double>(minimum), static_cast<double>(maximum),                  \
    defaults->Get##property(), &vtkNeuralMesh::Set##property)
#define PARAMETER(property)                                                                        \
  PARAMETER_IN(property, defaults->Get##property##MinValue(), defaults->Get##property##MaxValue())
  return {
    PARAMETER(WinnerRate),
    PARAMETER(SmoothingRate),
    PARAMETER(SmoothingIterations),
    PARAMETER(CounterDecay),
    PARAMETER(CounterHalfLife),
    PARAMETER(NoiseTolerance),
    PARAMETER(NoiseWindow),
    PARAMETER(OutlierLimit),
    PARAMETER(OutlierLimitVertices),
    PARAMETER(SamplesPerAddition),
    PARAMETER(EarlyPatience),
    PARAMETER(EarlyVertices),
    PARAMETER(AdditionsPerRemoval),
    PARAMETER(RemovalPatience),
    PARAMETER(RemovalLimit),
    PARAMETER_IN(EdgeFlips, 0, 1),
    PARAMETER(JumpFraction),
    PARAMETER(ListVertices),
    PARAMETER(BatchSize),
    PARAMETER(MaximumIterations),
    PARAMETER(TargetSampleDistance),
    PARAMETER(TargetCloudDistance),
    PARAMETER(StallPatience),
  };
#undef PARAMETER
#undef PARAMETER_IN
}

std::string Number(double value)
{
  std::ostringstream text;
  text << std::setprecision(10) << value;
  return text.str();
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
  if (equals == std::string::npos)
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
    throw UsageError(
      "--set: there is no parameter " + name + "; there are\n" + DescribeLearningParameters());
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size();
  if (!isNumber || !(value >= parameter->Minimum && value <= parameter->Maximum) ||
    (parameter->Integral && value != std::floor(value)))
  {
    throw UsageError("--set " + assignment + ": " + name + " must be " +
      (parameter->Integral ? "an integer" : "a number") + " from " + Number(parameter->Minimum) +
      " to " + Number(parameter->Maximum));
  }
  parameter->Set(filter, value);
}

std::string DescribeLearningParameters()
{
  std::ostringstream table;
  for (const LearningParameter& parameter : GetLearningParameters())
  {
    table << "  " << std::left << std::setw(22) << parameter.Name << " default " << std::setw(8)
          << Number(parameter.Default) << " range " << Number(parameter.Minimum) << " to "
          << Number(parameter.Maximum) << "\n";
  }
  return table.str();
}
