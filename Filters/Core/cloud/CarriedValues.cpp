// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/CarriedValues.h"

#include "cloud/AttributeFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
constexpr std::size_t ValuesAtOnce = AttributeFit::Values::SizeAtCompileTime;

/// What a component is fitted as: without its mean, with a range of 1.
struct Scale
{
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -std::numeric_limits<double>::infinity();
  double mean = 0.;

  void add(double value, double count)
  {
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
    mean += (value - mean) / count;
  }
  // Rounded, a mean may lie beside all values.
  double center() const { return std::clamp(mean, minimum, maximum); }
  double width() const { return maximum > minimum ? maximum - minimum : 1.; }
  double toFit(double value) const { return (value - center()) / width(); }
  double fromFit(double value) const
  {
    return std::clamp(center() + value * width(), minimum, maximum);
  }
};
}

std::vector<double> carryValues(const CloudPlaces& places, std::size_t components,
  const ValuesOfPoint& valuesOf, const Executor& executor)
{
  std::vector<double> values(components);
  // Calls `use` for each point that has finite values, which are then in `values`.
  const auto forEachPoint = [&](const auto& use)
  {
    places.forEach(
      [&](std::size_t point, const CloudPlaces::Corners& corners)
      {
        valuesOf(places.cloud().origins()[point], values.data());
        if (std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
        {
          use(corners, double(places.cloud().weight(point)));
        }
      });
  };
  std::vector<Scale> scales(components);
  double count = 0.;
  forEachPoint(
    [&](const auto&, double)
    {
      ++count;
      for (std::size_t i = 0; i < components; ++i)
      {
        scales[i].add(values[i], count);
      }
    });

  const std::vector<VertexIndex> nearest = places.nearestSupported();
  std::vector<double> result(nearest.size() * components);
  for (std::size_t first = 0; first < components; first += ValuesAtOnce)
  {
    const std::size_t lanes = std::min(ValuesAtOnce, components - first);
    AttributeFit fit(places.mesh(), executor);
    forEachPoint(
      [&](const CloudPlaces::Corners& corners, double weight)
      {
        AttributeFit::Values fitted = AttributeFit::Values::Zero();
        for (std::size_t lane = 0; lane < lanes; ++lane)
        {
          fitted[Eigen::Index(lane)] = scales[first + lane].toFit(values[first + lane]);
        }
        fit.add(corners, weight, fitted);
      });
    const std::vector<AttributeFit::Values> solution = fit.solve();
    for (VertexIndex v = 0; v < solution.size(); ++v)
    {
      // Where points have no values, the mesh has none.
      const bool isKnown = nearest[v] != NoVertex && fit.isSupported(nearest[v]);
      for (std::size_t lane = 0; lane < lanes; ++lane)
      {
        result[v * components + first + lane] = isKnown
          ? scales[first + lane].fromFit(solution[v][Eigen::Index(lane)])
          : std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return result;
}
}
