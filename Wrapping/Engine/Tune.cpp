// SPDX-License-Identifier: BSD-3-Clause
#include "Tune.h"

#include "base/ThreadPool.h"
#include "cloud/PointCloud.h"
#include "run/Tuning.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
/// A word where there is one.
nb::object objectOf(std::string_view parameter, double value)
{
  const std::string_view word = tunedWord(parameter, value);
  return word.empty() ? nb::object(nb::float_(value)) : nb::str(word.data(), word.size());
}

nb::dict dictOf(const TuningChoice& choice)
{
  nb::dict result;
  result["parameter"] = std::string(choice.parameter);
  result["before"] = objectOf(choice.parameter, choice.before);
  result["value"] = objectOf(choice.parameter, choice.value);
  return result;
}

nb::dict dictOf(const TuningTrial& trial)
{
  nb::dict result;
  result["parameter"] = std::string(trial.parameter);
  result["before"] = objectOf(trial.parameter, trial.before);
  result["value"] = objectOf(trial.parameter, trial.value);
  result["error"] = trial.error;
  result["gain"] = trial.gain;
  result["standard_error"] = trial.doubt;
  result["taken"] = trial.isTaken;
  return result;
}

template <typename Entry>
nb::list listOf(const std::vector<Entry>& entries)
{
  nb::list result;
  for (const Entry& entry : entries)
  {
    result.append(dictOf(entry));
  }
  return result;
}
}

nb::object tuneFor(
  const std::vector<AnyArray>& points, const Parameters& wanted, unsigned threads, Call& call)
{
  const PointSpans spans = spansOf(points);
  std::optional<Tuning> tuning;
  {
    const nb::gil_scoped_release unlocked;
    const ThreadPool executor(threads);
    const PointCloud cloud(spans, std::span<const double>(), false, executor);
    if (!cloud.hasExtent())
    {
      throw std::invalid_argument(spans.empty() ? "there are no points in it"
          : cloud.points().empty()              ? "no point of it is finite"
                                                : "there are no two points apart from each other");
    }
    tuning = tune(cloud, wanted, call.part(0., 1.), executor);
  }
  if (!tuning)
  {
    return nb::none();
  }
  nb::dict result;
  result["choices"] = listOf(tuning->choices);
  result["trials"] = listOf(tuning->trials);
  result["reasons"] = tuning->reasons();
  return result;
}
}
