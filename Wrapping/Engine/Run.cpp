// SPDX-License-Identifier: BSD-3-Clause
#include "Run.h"

#include "Report.h"
#include "Values.h"

#include "cloud/AttributeVote.h"
#include "cloud/CarriedValues.h"
#include "cloud/CoordinateRange.h"
#include "cloud/MeshBuilder.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nb = nanobind;

namespace neuralmesh::binding
{
namespace
{
/// Where parameters are chosen, if they are.
constexpr double EndOfChoice = 0.3;

void requireWeights(std::span<const double> weights)
{
  const auto isPositive = [](double weight) { return weight > 0. && std::isfinite(weight); };
  if (!weights.empty() && std::none_of(weights.begin(), weights.end(), isPositive))
  {
    throw std::invalid_argument("No weight is positive.");
  }
}
}

Run::Run(std::vector<AnyArray> points, std::optional<ArrayOf<double>> weights, Sides sides,
  bool keepsOrigins, unsigned threads)
  : points_(std::move(points))
  , sides_(std::move(sides))
  , hints_(sides_.hints())
  , executor_(threads)
{
  const PointSpans spans = spansOf(points_);
  const std::span<const double> weightsOfPoints =
    weights ? valuesOf(*weights) : std::span<const double>();
  requireWeights(weightsOfPoints);
  pointCount_ = spans.size();
  const nb::gil_scoped_release unlocked;
  times_.enter(Phase::Cloud);
  cloud_.emplace(spans, weightsOfPoints, keepsOrigins || hints_.needOrigins(), executor_);
  times_.leave();
  if (!cloud_->hasExtent())
  {
    throw std::invalid_argument(cloud_->points().empty() ? "No point of the input is finite."
                                                         : "All points of the input coincide.");
  }
}

bool Run::needsDoubles(std::size_t vertices) const
{
  return !rangeOf(*cloud_).fitsFloats(vertices, Eigen::Vector3d::Zero());
}

void Run::learn(Plan plan, Call& call)
{
  Parameters parameters = parametersOf(plan.parameters);
  seed_ = parameters.seed;
  const nb::gil_scoped_release unlocked;
  warnings_ = parameters.warnings(cloud_->points().size());
  std::optional<Mesh> first;
  try
  {
    if (plan.firstMesh)
    {
      first = buildMesh(std::move(*plan.firstMesh), *cloud_);
    }
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(
      std::string("Learning cannot start from the first mesh: ") + error.what() + ".");
  }
  if (first && first->vertexCount() > parameters.numberOfVertices)
  {
    warnings_.push_back("The mesh to start from has " + std::to_string(first->vertexCount()) +
      " vertices, more than " + std::to_string(parameters.numberOfVertices) +
      (parameters.fitRounds > 0 ? ": it is fitted, but grows no further."
                                : ": it comes out as it is."));
  }
  if (plan.isAutomatic)
  {
    chooseParameters(parameters, call);
  }
  const GrowthWatch watch{ plan.snapshots,
    [&](const GrowthSnapshot& snapshot)
    { call.with([&] { plan.takeSnapshot(meshOf(snapshot, true)); }); } };
  const CheckpointPlan checkpoint{ .path = plan.checkpoint,
    .interval = plan.checkpointInterval,
    .warn =
      [&](const std::string& text)
    { warnings_.push_back("The run goes on without a checkpoint: " + text); },
    .areParametersChosen = isChoiceWhole_ };
  try
  {
    result_ = reconstruct(*cloud_, parameters,
      call.part(plan.isAutomatic ? EndOfChoice : 0., plan.endOfMesh), first,
      plan.snapshots > 0 ? watch : GrowthWatch(), checkpoint, executor_, hints_, plan.explainsAll);
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(std::string("Of the checkpoint: ") + error.what() + ".");
  }
  warnings_.insert(warnings_.end(), result_.warnings.begin(), result_.warnings.end());
  times_.add(result_.times);
}

/// Whoever ends the run while parameters are chosen ends it with them as they were.
void Run::chooseParameters(Parameters& parameters, Call& call)
{
  times_.enter(Phase::Choice);
  tuning_ = tune(*cloud_, parameters, call.part(0., EndOfChoice), executor_);
  isChoiceWhole_ = tuning_.has_value();
  if (!tuning_)
  {
    tuning_ = Tuning{ parameters, {}, {}, {} };
  }
  parameters = tuning_->parameters;
  times_.leave();
}

nb::dict Run::mesh(bool isDouble) const
{
  nb::dict mesh = meshOf(result_, isDouble);
  nb::dict fields;
  fields["NumberOfVertices"] = result_.mesh.points.size();
  fields["Iterations"] = result_.counts.iterations;
  fields["Seed"] = seed_;
  fields["StopReason"] = stopReason();
  fields["DroppedPoints"] = cloud_->droppedCount();
  if (tuning_)
  {
    addTuning(*tuning_, fields);
  }
  addSides(result_.orientation, fields);
  if (result_.quality)
  {
    addQuality(result_, cloud_->unit(), fields);
  }
  if (result_.explanation)
  {
    addCounts(*result_.explanation, fields);
  }
  fields["Warnings"] = warnings_;
  mesh["field_data"] = fields;
  return mesh;
}

nb::dict Run::curve() const { return curveOf(result_.curve); }

nb::dict Run::explained() const
{
  return result_.explanation ? explainedOf(*result_.explanation, *cloud_, pointCount_) : nb::dict();
}

nb::dict Run::times() const
{
  nb::dict seconds;
  seconds["Cloud"] = times_.seconds(Phase::Cloud);
  seconds["Choice"] = times_.seconds(Phase::Choice);
  seconds["Start"] = times_.seconds(Phase::Start);
  seconds["Learning"] = times_.seconds(Phase::Learning);
  seconds["Finish"] = times_.seconds(Phase::Finish);
  return seconds;
}

std::string Run::stopReason() const { return std::string(name(result_.stopReason)); }

bool Run::findPlaces(Call& call, double begin, double end)
{
  const nb::gil_scoped_release unlocked;
  places_.emplace(*cloud_, result_.surface, call.part(begin, end), executor_);
  return call.goesOn();
}

nb::object Run::fit(const ArrayOf<double>& values) const
{
  const std::size_t components = values.size() / std::max<std::size_t>(1, pointCount_);
  std::vector<double> fitted;
  {
    const nb::gil_scoped_release unlocked;
    fitted = carryValues(
      *places_, components,
      [&](std::size_t origin, double* ofPoint)
      { std::copy_n(values.data() + components * origin, components, ofPoint); },
      executor_);
  }
  return arrayOf(std::move(fitted), components);
}

nb::object Run::vote(const ArrayOf<std::uint32_t>& kinds) const
{
  std::vector<std::uint32_t> winners;
  {
    const nb::gil_scoped_release unlocked;
    const std::span<const std::uint32_t> origins = cloud_->origins();
    // A kind has the number of its first point that counts.
    std::vector<std::uint32_t> first(pointCount_, NoLabel);
    for (const std::uint32_t origin : origins)
    {
      std::uint32_t& lowest = first[kinds.data()[origin]];
      lowest = std::min(lowest, origin);
    }
    std::vector<std::uint32_t> labels(origins.size());
    std::transform(origins.begin(), origins.end(), labels.begin(),
      [&](std::uint32_t origin) { return first[kinds.data()[origin]]; });
    winners = voteForLabels(*places_, labels);
  }
  return arrayOf(std::move(winners));
}
}
