// SPDX-License-Identifier: BSD-3-Clause
#include "run/SizeChoice.h"

#include "base/WarningTopic.h"
#include "learn/StoppingRules.h"
#include "run/Exclusions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

namespace neuralmesh
{
namespace
{
/// With fewer points there is no surface on which sizes can be tried.
constexpr std::size_t FewestToChooseBy = 500;

std::string lengthText(double length)
{
  std::ostringstream stream;
  stream.precision(3);
  stream << length;
  return stream.str();
}

std::string_view measureText(ToleranceMeasure measure)
{
  switch (measure)
  {
    case ToleranceMeasure::NinetyNinePercent:
      return "99 % of the distances";
    case ToleranceMeasure::Largest:
      return "the largest distance";
    case ToleranceMeasure::RootMeanSquare:
      break;
  }
  return "root mean square distance";
}

/// The power of the number of vertices by which the error falls between two trials; 0 if it does
/// not fall.
double exponentOf(const SizeTrial& fewer, const SizeTrial& more)
{
  const double gain = std::log(fewer.error / more.error);
  return std::isfinite(gain) && more.vertices > fewer.vertices
    ? std::max(0., gain / std::log(double(more.vertices) / double(fewer.vertices)))
    : 0.;
}
}

double SizeGoal::lengthFor(const PointCloud& cloud) const
{
  return isPercent ? tolerance / 100. * cloud.diagonal() * cloud.unit() : tolerance;
}

std::optional<SizeGoal> sizeGoalOf(
  std::uint64_t vertices, double tolerance, bool isPercent, ToleranceMeasure measure)
{
  return vertices == 0 || tolerance > 0. ? std::optional(SizeGoal{ tolerance, isPercent, measure })
                                         : std::nullopt;
}

std::string whyNoSize(const Parameters& parameters, const BesideSize& beside)
{
  return whyExcluded("A number of vertices that is to be found, by itself or by a tolerance,",
    { { beside.firstMesh, "a first mesh or an ensemble" }, { beside.checkpoint, "a checkpoint" },
      { beside.snapshots, "growth as time" },
      { beside.automatic, "the automatic choice of parameters" }, { beside.levels, "levels" },
      { mayEndBeforeVertices(parameters), "a stopping rule other than the number of vertices" } });
}

std::string whyNoSizeFor(const PointCloud& cloud, const SizeGoal& goal)
{
  const std::size_t points = cloud.differentCount();
  if (points < FewestToChooseBy)
  {
    return "There are " + std::to_string(points) + " points. The program needs " +
      std::to_string(FewestToChooseBy) + " to find a number of vertices: give the number.";
  }
  const double diagonal = cloud.diagonal() * cloud.unit();
  if (goal.lengthFor(cloud) >= diagonal)
  {
    return "The tolerance is " + lengthText(goal.lengthFor(cloud)) +
      ", and the points lie in a box whose diagonal is " + lengthText(diagonal) +
      ": any mesh meets it.";
  }
  return {};
}

double ErrorUnderNoise::errorWith(std::uint64_t vertices) const
{
  return std::hypot(coarseness * std::pow(double(vertices), -exponent), floor);
}

std::optional<double> SizeChoice::expectedWith(std::uint64_t wanted) const
{
  if (byNoise)
  {
    return byNoise->errorWith(wanted);
  }
  // Trials of nearly the same size do not determine a power.
  constexpr double TimesApart = 1.3;
  std::vector<SizeTrial> known;
  for (const SizeTrial& trial : trials)
  {
    if (double(trial.vertices) * TimesApart <= double(vertices))
    {
      known.push_back(trial);
    }
  }
  const auto larger = std::ranges::find_if(trials,
    [&](const SizeTrial& trial)
    { return double(trial.vertices) >= TimesApart * double(vertices); });
  if ((known.empty() && larger == trials.end()) || !(reached > least))
  {
    return {};
  }
  const SizeTrial own{ vertices, reached };
  double exponent = known.empty() ? exponentOf(own, *larger) : exponentOf(known.back(), own);
  if (wanted > vertices && known.size() > 1)
  {
    // The power falls: more vertices do not reduce the error that noise and edges cause.
    const double before = exponentOf(known[known.size() - 2], known.back());
    exponent *= before > 0. ? std::min(1., exponent / before) : 1.;
  }
  return reached * std::pow(double(vertices) / double(wanted), exponent);
}

std::vector<std::string> SizeChoice::reasons() const
{
  std::vector<std::string> lines;
  const std::string of(measureText(goal.measure));
  if (goal.isAutomatic())
  {
    lines.push_back(byCreases ? "the shape has creases: more vertices would not make them sharper"
        : noise > 0.          ? "as many as the points support with a noise of " + lengthText(noise)
                              : "no noise was measured: more vertices would follow single points");
  }
  else
  {
    lines.push_back("the fewest vertices that meet the tolerance of " + lengthText(length) + " (" +
      of + ")" + (noise > 0. ? ", without the noise of " + lengthText(noise) : ""));
  }
  std::string tried;
  for (const SizeTrial& trial : trials)
  {
    tried += (tried.empty() ? "tried: " : ", ") + std::to_string(trial.vertices) + " vertices " +
      lengthText(trial.error);
  }
  if (!tried.empty())
  {
    lines.push_back(tried);
  }
  const bool isTold = reached > least;
  lines.push_back("predicted " + lengthText(predicted) + ", reached " +
    (isTold
        ? lengthText(reached)
        : "less than " + lengthText(least) + ", the least that can be measured under the noise"));
  const auto half = expectedWith(std::max<std::uint64_t>(1, vertices / 2));
  const auto twice = expectedWith(2 * vertices);
  if (half && twice)
  {
    lines.push_back("half as many would give about " + lengthText(*half) +
      ", twice as many about " + lengthText(*twice));
  }
  return lines;
}

std::string SizeChoice::warning() const
{
  if (goal.isAutomatic() || std::max(reached, least) <= length)
  {
    return {};
  }
  const std::string text = reached <= least
    ? "The tolerance of " + lengthText(length) +
      " is less than the noise of the points allows to " + "measure, " + lengthText(least) + "."
    : "The tolerance of " + lengthText(length) + " is not met: the mesh of " +
      std::to_string(vertices) + " vertices reaches " + lengthText(reached) + ".";
  return taggedWarning(WarningTopic::NumberNotFound,
    text + " The field data Choice has the reasons. Use a larger tolerance or more points.");
}
}
