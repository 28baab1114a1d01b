// SPDX-License-Identifier: BSD-3-Clause
#include "Run.h"

#include "Report.h"
#include "Values.h"

#include "cloud/AttributeNumbers.h"
#include "cloud/AttributeVote.h"
#include "cloud/CoordinateRange.h"
#include "cloud/MeshBuilder.h"
#include "run/AutomaticReconstruction.h"
#include "run/EnsembleRun.h"
#include "run/Levels.h"
#include "run/Remeshing.h"
#include "run/SizedReconstruction.h"
#include "run/Warnings.h"

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
  if (weights && weights->size() != pointCount_)
  {
    throw std::invalid_argument("there are not as many weights as points");
  }
  sides_.requireCount(pointCount_);
  const nb::gil_scoped_release unlocked;
  times_.enter(Phase::Cloud);
  cloud_.emplace(spans, weightsOfPoints, keepsOrigins || hints_.needOrigins(), executor_);
  times_.leave();
  if (!cloud_->hasExtent())
  {
    throw std::invalid_argument(cloud_->whyNoExtent());
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
  std::optional<EnsembleParameters> ensemble;
  if (plan.ensemble)
  {
    ensemble = ensembleParametersOf(*plan.ensemble);
  }
  const nb::gil_scoped_release unlocked;
  const Tell tell = [&](const char* kind, const std::string& text)
  {
    if (!plan.tell.is_none())
    {
      call.with([&] { plan.tell(kind, text); });
    }
  };
  std::optional<Mesh> first = firstMeshOf(std::move(plan.firstMesh));
  if (!plan.levels.empty())
  {
    parameters.numberOfVertices = plan.levels.back();
    const std::string problem = whyNoLevels(plan.levels, parameters,
      { .firstMesh = first || ensemble,
        .checkpoint = !plan.checkpoint.empty(),
        .automatic = plan.isAutomatic });
    if (!problem.empty())
    {
      throw std::invalid_argument(problem);
    }
  }
  const bool remeshes = plan.warningOfSurface.has_value();
  const bool isSizeToBeFound = plan.size.tolerance > 0. || parameters.numberOfVertices == 0;
  if (isSizeToBeFound && !remeshes)
  {
    std::string problem = whyNoSize(parameters,
      { .firstMesh = first || ensemble,
        .checkpoint = !plan.checkpoint.empty(),
        .automatic = plan.isAutomatic,
        .levels = !plan.levels.empty() });
    problem = problem.empty() ? whyNoSizeFor(*cloud_, plan.size) : problem;
    if (!problem.empty())
    {
      throw std::invalid_argument(problem);
    }
    parameters.numberOfVertices = std::max<std::uint64_t>(4, cloud_->points().size() / 2);
  }
  if (remeshes && !plan.warningOfSurface->empty())
  {
    warn({ *plan.warningOfSurface }, tell);
  }
  if (!remeshes)
  {
    warn(parameters.warnings(cloud_->points().size()), tell);
  }
  CheckpointPlan checkpoint{ .path = plan.checkpoint,
    .interval = plan.checkpointInterval,
    .warn = [&](const std::string& text)
    {
      checkpointWarnings_.push_back("The run goes on without a checkpoint: " + text);
      tell("warning", checkpointWarnings_.back());
    } };
  double begin = 0.;
  if (ensemble)
  {
    begin = startFrom(*ensemble, parameters, checkpoint, first, tell, call);
  }
  if (first && !remeshes)
  {
    if (const std::string warning = warningOfFirst(*first, parameters); !warning.empty())
    {
      warn({ warning }, tell);
    }
  }
  GrowthWatch watch;
  if (plan.snapshots > 0)
  {
    watch = { plan.snapshots, [&](const GrowthSnapshot& snapshot) {
               call.with([&] { plan.takeSnapshot(meshOf(snapshot, true)); });
             } };
  }
  const Progress progress = call.part(begin, plan.endOfMesh);
  try
  {
    if (plan.isAutomatic)
    {
      AutomaticReconstruction automatic = reconstructAutomatically(
        *cloud_, parameters, progress,
        [&](const Tuning& tuning)
        {
          for (const std::string& text : textsOf(tuning))
          {
            tell("choice", text);
          }
        },
        first, watch, checkpoint, executor_, hints_, plan.explainsAll);
      tuning_ = std::move(automatic.tuning);
      result_ = std::move(automatic.reconstruction);
    }
    else if (!plan.levels.empty())
    {
      result_ = reconstructLevels(
        { *cloud_, parameters, first, executor_, hints_, plan.explainsAll }, plan.levels,
        [&](std::size_t, Reconstruction level)
        {
          tellWarnings(level, std::to_string(level.mesh.points.size()) + " vertices: ", tell);
          smaller_.push_back(std::move(level));
        },
        progress);
      shown_ = smaller_.size();
    }
    else if (remeshes && first)
    {
      result_ = remesh(
        *cloud_, parameters, std::move(*first),
        [this](std::size_t point) { return Vector4(hints_.normalOf(cloud_->origins()[point])); },
        progress, executor_);
    }
    else if (isSizeToBeFound)
    {
      result_ = reconstructSized(
        { *cloud_, parameters, first, executor_, hints_, plan.explainsAll }, plan.size, progress);
    }
    else
    {
      result_ = reconstruct(*cloud_, parameters, progress, first, watch, checkpoint, executor_,
        hints_, plan.explainsAll);
    }
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(std::string("The checkpoint: ") + error.what() + ".");
  }
  tellWarnings(result_, "", tell);
}

void Run::tellWarnings(const Reconstruction& result, const std::string& of, const Tell& tell)
{
  for (const std::string& text : result.warnings)
  {
    resultWarnings_.push_back(of + text);
    tell("warning", resultWarnings_.back());
  }
  times_.add(result.times);
}

void Run::warn(const std::vector<std::string>& texts, const Tell& tell)
{
  for (const std::string& text : texts)
  {
    warnings_.push_back(text);
    tell("warning", text);
  }
}

std::vector<std::string> Run::warnings() const
{
  std::vector<std::string> all = warnings_;
  all.insert(all.end(), resultWarnings_.begin(), resultWarnings_.end());
  all.insert(all.end(), checkpointWarnings_.begin(), checkpointWarnings_.end());
  return all;
}

std::optional<Mesh> Run::firstMeshOf(std::optional<TriangleMesh> triangles) const
{
  try
  {
    return triangles ? std::optional(buildMesh(std::move(*triangles), *cloud_)) : std::nullopt;
  }
  catch (const std::runtime_error& error)
  {
    throw std::invalid_argument(
      std::string("Learning cannot start from the first mesh: ") + error.what() + ".");
  }
}

/// Returns where the refinement begins, as a fraction of the whole run.
double Run::startFrom(const EnsembleParameters& ensemble, Parameters& parameters,
  CheckpointPlan& checkpoint, std::optional<Mesh>& first, const Tell& tell, Call& call)
{
  EnsembleStart start = startByEnsemble(
    *cloud_, ensemble, parameters, call.part(0., 1.),
    [&](EnsembleStep step) { tell("step", std::string(name(step))); }, executor_);
  parameters.timeLimit = start.timeLimit;
  checkpoint.isStartWhole = start.votes.has_value();
  if (!start.warning.empty())
  {
    warn({ start.warning }, tell);
  }
  if (start.isAverage())
  {
    average_ = neuralmesh::trianglesOf(*start.mesh, *cloud_);
  }
  votes_ = std::move(start.votes);
  first = std::move(start.mesh);
  return start.end;
}

nb::dict Run::average(bool isDouble) const
{
  return average_ ? meshOf(*average_, isDouble) : nb::dict();
}

nb::dict Run::votes() const
{
  nb::dict result;
  if (votes_)
  {
    std::vector<float> shares(votes_->votes.size());
    std::transform(votes_->votes.begin(), votes_->votes.end(), shares.begin(),
      [&](std::uint8_t count) { return float(count) / float(votes_->voters); });
    result["values"] = arrayOf(std::move(shares));
    result["origin"] =
      nb::make_tuple(votes_->grid.first.x(), votes_->grid.first.y(), votes_->grid.first.z());
    result["spacing"] = votes_->grid.width;
  }
  return result;
}

nb::dict Run::mesh(bool isDouble) const
{
  const Reconstruction& result = shown();
  nb::dict mesh = meshOf(result, isDouble);
  nb::dict fields;
  fields["NumberOfVertices"] = result.mesh.points.size();
  fields["Iterations"] = result.counts.iterations;
  fields["Seed"] = seed_;
  fields["StopReason"] = stopReason();
  fields["DroppedPoints"] = cloud_->droppedCount();
  if (tuning_)
  {
    addTuning(*tuning_, fields);
  }
  if (result.size)
  {
    addSize(*result.size, fields);
  }
  addSides(result.orientation, fields);
  if (result.quality)
  {
    addQuality(result, cloud_->unit(), fields);
  }
  if (result.explanation)
  {
    addCounts(*result.explanation, fields);
  }
  std::vector<std::string> texts = warnings_;
  texts.insert(texts.end(), result.warnings.begin(), result.warnings.end());
  fields["Warnings"] = texts;
  mesh["field_data"] = fields;
  return mesh;
}

nb::dict Run::curve() const { return curveOf(result_.curve); }

nb::dict Run::explained() const
{
  return result_.explanation ? explainedOf(*result_.explanation, *cloud_, pointCount_) : nb::dict();
}

nb::dict Run::featureLines(double angle, bool isDouble, Call& call, double begin, double end) const
{
  std::optional<FeatureLines> lines;
  {
    const nb::gil_scoped_release unlocked;
    lines = findFeatureLines(result_.surface, *cloud_, angle, call.part(begin, end), executor_);
  }
  return lines ? linesOf(*lines, isDouble) : nb::dict();
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

std::string Run::stopReason() const { return std::string(name(shown().stopReason)); }

bool Run::findPlaces(Call& call, double begin, double end)
{
  const nb::gil_scoped_release unlocked;
  places_.emplace(*cloud_, shown().surface, call.part(begin, end), executor_);
  return call.goesOn();
}

void Run::requirePointData(std::size_t rows) const
{
  if (rows != pointCount_)
  {
    throw std::invalid_argument("point data has not as many rows as there are points");
  }
}

nb::object Run::fit(const ArrayOf<double>& values) const
{
  requirePointData(values.shape(0));
  const std::size_t components = values.size() / std::max<std::size_t>(1, pointCount_);
  std::vector<double> fitted;
  {
    const nb::gil_scoped_release unlocked;
    fitted = carryNumbers(
      *places_, components,
      [&](std::uint32_t point, std::span<double> tuple)
      { std::copy_n(values.data() + components * point, components, tuple.data()); },
      executor_);
  }
  return arrayOf(std::move(fitted), components);
}

nb::object Run::vote(const ArrayOf<std::uint32_t>& kinds) const
{
  requirePointData(kinds.shape(0));
  std::vector<std::uint32_t> winners;
  {
    const nb::gil_scoped_release unlocked;
    const std::span<const std::uint32_t> origins = cloud_->origins();
    // The label of a kind is the first of its points that count.
    std::vector<std::uint32_t> first(pointCount_, NoLabel);
    for (const std::uint32_t origin : origins)
    {
      std::uint32_t& label = first[kinds.data()[origin]];
      label = std::min(label, origin);
    }
    std::vector<std::uint32_t> labels(origins.size());
    std::transform(origins.begin(), origins.end(), labels.begin(),
      [&](std::uint32_t origin) { return first[kinds.data()[origin]]; });
    winners = voteForLabels(*places_, labels);
  }
  return arrayOf(std::move(winners));
}
}
