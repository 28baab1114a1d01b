// SPDX-License-Identifier: BSD-3-Clause
#include "cloud/AttributeNumbers.h"

#include "cloud/AttributeFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace neuralmesh
{
namespace
{
constexpr std::size_t ComponentsAtOnce = 4; ///< components that are fitted at once

/// What a component is fitted as: without its mean, with a range of 1.
class ComponentScale
{
public:
  void add(double value, double count)
  {
    minimum_ = std::min(minimum_, value);
    maximum_ = std::max(maximum_, value);
    mean_ += (value - mean_) / count;
  }
  double toFit(double value) const { return (value - center()) / width(); }
  double fromFit(double value) const
  {
    return std::clamp(center() + value * width(), minimum_, maximum_);
  }

private:
  // Rounded, a mean may lie beside all values.
  double center() const { return std::clamp(mean_, minimum_, maximum_); }
  double width() const { return maximum_ > minimum_ ? maximum_ - minimum_ : 1.; }

  double minimum_ = std::numeric_limits<double>::infinity();
  double maximum_ = -std::numeric_limits<double>::infinity();
  double mean_ = 0.;
};
}

std::vector<double> carryNumbers(const CloudPlaces& places, std::size_t components,
  const NumbersOf& numbersOf, const Executor& executor)
{
  std::vector<double> tuple(components);
  // Calls `use` for each point that has finite numbers, which are then in `tuple`.
  const auto forEachTuple = [&](const auto& use)
  {
    places.forEach(
      [&](std::size_t point, const CloudPlaces::Corners& corners)
      {
        numbersOf(places.cloud().origins()[point], tuple);
        if (std::all_of(tuple.begin(), tuple.end(), [](double x) { return std::isfinite(x); }))
        {
          use(corners, double(places.cloud().weight(point)));
        }
      });
  };
  std::vector<ComponentScale> scales(components);
  double count = 0.;
  forEachTuple(
    [&](const auto&, double)
    {
      ++count;
      for (std::size_t i = 0; i < components; ++i)
      {
        scales[i].add(tuple[i], count);
      }
    });

  const std::vector<VertexIndex> nearest = places.nearestSupported();
  std::vector<double> result(components * nearest.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t first = 0; first < components; first += ComponentsAtOnce)
  {
    const std::size_t lanes = std::min(ComponentsAtOnce, components - first);
    AttributeFit fit(places.mesh(), executor);
    forEachTuple(
      [&](const CloudPlaces::Corners& corners, double weight)
      {
        AttributeFit::Values values = AttributeFit::Values::Zero();
        for (std::size_t lane = 0; lane < lanes; ++lane)
        {
          values[Eigen::Index(lane)] = scales[first + lane].toFit(tuple[first + lane]);
        }
        fit.add(corners, weight, values);
      });
    const std::vector<AttributeFit::Values> solution = fit.solve();
    for (VertexIndex v = 0; v < solution.size(); ++v)
    {
      // Where points have no numbers, the mesh has none.
      if (nearest[v] != NoVertex && fit.isSupported(nearest[v]))
      {
        for (std::size_t lane = 0; lane < lanes; ++lane)
        {
          result[v * components + first + lane] =
            scales[first + lane].fromFit(solution[v][Eigen::Index(lane)]);
        }
      }
    }
  }
  return result;
}
}
