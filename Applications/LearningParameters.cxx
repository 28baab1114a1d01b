// SPDX-License-Identifier: BSD-3-Clause
#include "LearningParameters.h"

#include "NearestNames.h"
#include "OneLine.h"
#include "vtkNeuralMeshEnsemble.h"

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

template <typename OwnerT, typename ValueT>
LearningParameter Describe(const char* name, const char* description, double minimum,
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
  return { name, description, minimum, maximum, static_cast<double>(defaultValue),
    std::is_integral_v<ValueT>, {}, setValue };
}

LearningParameter WithWords(LearningParameter parameter, std::vector<std::string> words)
{
  parameter.Words = std::move(words);
  return parameter;
}

std::vector<LearningParameter> MakeParameters()
{
  vtkNew<vtkNeuralMeshEnsemble> defaults;
#define PARAMETER_IN(property, minimum, maximum, description)                                      \
  Describe(#property, description, static_cast<double>(minimum), static_cast<double>(maximum),     \
    defaults->Get##property(), &vtkNeuralMeshEnsemble::Set##property)
#define PARAMETER(property, description)                                                           \
  PARAMETER_IN(property, defaults->Get##property##MinValue(), defaults->Get##property##MaxValue(), \
    description)
  return {
    PARAMETER(WinnerRate, "how far the winner moves to the sample"),
    PARAMETER(SmoothingRate, "how far its neighbours are smoothed"),
    PARAMETER(SmoothingIterations, "how often they are smoothed for a sample"),
    PARAMETER(CounterDecay, "what a sample leaves of all counters (basic)"),
    PARAMETER(CounterHalfLife, "samples per vertex that halve a counter (noise, normal)"),
    PARAMETER(NoiseTolerance, "deviations from which on samples pull less (noise)"),
    PARAMETER(NoiseWindow, "distances behind mean and deviation"),
    PARAMETER(OutlierLimit, "how far beyond that samples are ignored; 0: never"),
    PARAMETER(OutlierLimitVertices, "... from so many vertices on"),
    PARAMETER(ChangeWindow, "changes by moves behind their mean"),
    PARAMETER(GainLimit, "mean changes that a change counts as at most; 0: any"),
    PARAMETER(FeatureMemory, "what a win leaves of feature strength (--features)"),
    PARAMETER(FeatureSamples, "samples per vertex for it, after growth (--features)"),
    PARAMETER(SamplesPerAddition, "samples between two new vertices"),
    PARAMETER(EarlyPatience, "how many times more of them at first"),
    PARAMETER(EarlyVertices, "... until there are so many vertices"),
    PARAMETER(AdditionsPerRemoval, "new vertices between two removals (noise)"),
    PARAMETER(RemovalPatience, "samples per vertex without a win until removal"),
    PARAMETER(RemovalLimit, "removals for a new vertex at most; 0: any (noise)"),
    PARAMETER_IN(EdgeFlips, 0, 1, "flips towards valence 6, 1 or 0"),
    WithWords(PARAMETER(AdditionOperation, "what adds a vertex"), { "vertex_split", "edge_split" }),
    WithWords(PARAMETER(RemovalOperation, "what removes a vertex"),
      { "half_edge_collapse", "full_edge_collapse", "vertex_delete" }),
    WithWords(PARAMETER(TopologyRules, "by which rules (topology)"), { "mended", "thesis" }),
    PARAMETER(TopologyPatience, "samples per vertex between two calls (topology)"),
    PARAMETER(TriangleRemovalFactor, "mean areas beyond which a triangle goes (topology)"),
    PARAMETER(BoundaryMergingFactor, "how close boundaries are joined (topology)"),
    PARAMETER(JumpFraction, "how far a winner jumps, part of n (list)"),
    PARAMETER(ConstantWeight, "parts in the weighted jump (list)"),
    PARAMETER(NormalWeight, "... of the turn of the normal"),
    PARAMETER(AreaWeight, "... of the change of area"),
    PARAMETER(VolumeWeight, "... of the change of volume"),
    PARAMETER(ListVertices, "counters until there are so many vertices (list)"),
    PARAMETER(MaximumPoints, "points drawn with --in-place; 0: 50 a vertex or a million"),
    PARAMETER(BatchSize, "samples drawn at once at most"),
    WithWords(PARAMETER(Start, "what learning starts from"), { "occupied_space", "tetrahedron" }),
    PARAMETER(CurvatureDensity, "denser where it bends, by its curvature to that power; 0: not"),
    PARAMETER(FitRounds, "rounds of the fit after learning; 0: none"),
    PARAMETER(FitSmoothness, "how smooth the fit is; 0: by the noise and the shape"),
    PARAMETER(FitSamples, "samples per vertex in the fit"),
    PARAMETER(MaximumIterations, "end after so many samples; 0: never"),
    PARAMETER(TargetSampleDistance, "end at this mean distance to winners, part of diagonal"),
    PARAMETER(TargetCloudDistance, "end at this mean distance to the mesh, part of diagonal"),
    PARAMETER(TargetNormalChange, "end at this mean change of normals, 1 - cosine"),
    PARAMETER(StallPatience, "end after so many samples per vertex without growth"),
    PARAMETER(VerticesPerMember, "vertices of a member (ensemble)"),
    PARAMETER(MemberSamplesPerAddition, "its samples between two new vertices (ensemble)"),
    PARAMETER(MemberRemovalPatience, "its samples per vertex until removal (ensemble)"),
    PARAMETER(GridResolution, "voxels along the longest side (ensemble)"),
  };
#undef PARAMETER
#undef PARAMETER_IN
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
