// SPDX-License-Identifier: BSD-3-Clause
#include "run/SizedReconstruction.h"

#include "fit/CreaseRefinement.h"
#include "run/HeldOutError.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// A trial and the result take these parts of the progress that is left.
constexpr double PartOfTrial = 0.2, PartOfResult = 0.9;
/// The part of growth in a trial.
constexpr double PartOfGrowthOfTrial = 0.4;
constexpr std::uint64_t FewestTried = 25;

// Without a tolerance: two small trials. The second one measures the noise.
constexpr std::uint64_t PointsPerVertexAtFirst = 128;
constexpr std::uint64_t PointsPerVertexAtSecond = 32;
/// With fewer points per vertex, the shape hides the noise between neighbours.
constexpr std::uint64_t FewestPointsThatTellNoise = 8;
/// Measuring noise takes time, so only the first trials do it.
constexpr std::size_t MostThatTellNoise = 2;
/// More vertices than these gain almost nothing.
constexpr double PointsPerVertexIfClean = 2.2, PointsPerVertexUnderNoise = 3.3;
constexpr double PointsPerVertexAtLeast = 10.;
/// ... and than these if the surface has creases: they tell most of the error, and are as sharp as points tell. The
/// length of a crease stays the same in a finer mesh; bends lose more than this part of theirs.
constexpr double PointsPerVertexAtCreases = 6.25;
constexpr double CreasesThatStay = 0.85;
/// Without noise, the error falls by a power of the number of vertices. Its exponent shrinks to so
/// many times that of the trials.
constexpr double ExponentAfterTrials = 0.62;
/// The mean square error of a coarse mesh falls by this power of the number of vertices.
constexpr double PowerOfCoarseness = 1.7;
/// The chosen mesh has this part of the coarseness that it has where coarseness equals noise.
constexpr double CoarsenessLeft = 0.04;

// With a tolerance
constexpr std::uint64_t PointsPerVertexOfGuess = 100;
constexpr std::uint64_t FewestToAsk = 4;
/// The first surface of the first trial also suits meshes of so many times its vertices.
constexpr std::uint64_t TimesFirst = 4;
constexpr std::size_t MostTrials = 8;
/// A trial stays within these factors of earlier trials, as errors of sizes farther off are not
/// predictable.
constexpr double MostTimesMore = 6., MostTimesFewer = 8.;
/// A trial has at least so many times the vertices of the largest one that missed the tolerance.
constexpr double LeastTimesMore = 1.03;
/// A finished mesh is refined to up to so many times its vertices. A larger mesh has to learn.
constexpr double MostTimesRefined = 1.3;
/// A mesh that is refined a little is fitted twice and comes closer than other meshes of its size.
/// So it needs only this part of the vertices.
constexpr double MostTimesForGain = 1.2, PartWithGain = 0.93;
/// Errors vary from run to run. So a trial has so many times the vertices that are expected to be
/// just enough, and each refined trial that misses the tolerance adds as much.
constexpr double TimesEnough = 1.04;
/// On a clean cloud, a mesh that is too large costs less than one that is too small: it is
/// simplified with a short fit. So the first step to a larger mesh is longer by its own ratio to this
/// power: no trial has shown yet how fast the error falls.
constexpr double ExcessIfClean = 0.25;
/// The search ends at a mesh with up to so many times the vertices that are just enough.
constexpr double TimesTaken = 1.06;
constexpr double LeastExponent = 0.15, UsualExponent = 0.78, MostExponent = 2.5;

/// Whether the difference between neighbours is noise: whether it is larger than the shape makes
/// it. The shape makes it larger if there are fewer points per vertex.
bool isNoiseBy(double difference, double error, std::uint64_t vertices, std::uint64_t points)
{
  constexpr double Part = 0.6;
  const double part =
    Part * std::cbrt(double(PointsPerVertexAtSecond) * double(vertices) / double(points));
  return difference > std::min(part, 0.95) * error;
}

/// The least error that differs from 0 significantly, by the standard error of a mean square under
/// noise.
double leastTold(const HeldOutError& error, double noise)
{
  return noise * std::pow(8. / std::max(1., double(error.count)), 0.25);
}

/// A run that grows one mesh, and finishes copies of it.
class SizedRun
{
public:
  SizedRun(const RunRequest& request, const SizeGoal& goal, const Progress& progress)
    : request_(request)
    , progress_(progress)
    , run_(request, progress_)
    , points_(request.cloud.differentCount())
    , none_({}, request.cloud, request.parameters)
  {
    choice_.goal = goal;
    choice_.length = goal.lengthFor(request.cloud);
  }

  Reconstruction run() { return choice_.goal.isAutomatic() ? runByCloud() : runByTolerance(); }

private:
  struct Measured
  {
    std::uint64_t vertices = 0;
    HeldOutError error;
    double creases = 0.; ///< see creaseWidths()
  };

  Reconstruction runByCloud()
  {
    const std::uint64_t first = std::max(FewestTried, points_ / PointsPerVertexAtFirst);
    const std::uint64_t second = std::max(4 * first, points_ / PointsPerVertexAtSecond);
    if (!tryWith(first, second) || !tryWith(second, second))
    {
      return *std::move(ended_);
    }
    const std::uint64_t vertices = sizeByCloud();
    const Measured& last = measured_.back();
    const double exponent =
      ExponentAfterTrials * slopeBetween(measured_.size() - 2, measured_.size() - 1).exponent;
    choice_.predicted = choice_.byNoise
      ? choice_.byNoise->errorWith(vertices)
      : errorOf(last.error) * std::pow(double(last.vertices) / double(vertices), exponent);
    return conclude(ownRun(vertices));
  }

  /// A finished mesh with its error.
  struct Made
  {
    LearntRun run;
    HeldOutError error;
    /// Whether it was made from a finished mesh, with the number that was expected to be enough
    bool isMadeAgain = false;

    std::uint64_t vertices() const { return run.learnt.mesh.vertexCount(); }
  };

  bool meets(const HeldOutError& error) const { return errorOf(error) <= choice_.length; }

  /// Makes trials until one meets the tolerance and has few vertices more than necessary. That one
  /// is the result.
  Reconstruction runByTolerance()
  {
    // Smaller meshes are simplified from the least size that a run learns, so they cost no less.
    const Parameters fewest = parametersWith(FewestToAsk);
    std::uint64_t vertices = std::min(mostVertices(),
      std::max({ FewestTried, points_ / PointsPerVertexOfGuess,
        verticesToLearn(requestWith(request_, fewest)) }));
    for (std::size_t trial = 0; trial < MostTrials; ++trial)
    {
      choice_.predicted = measured_.empty() ? choice_.length : expected(vertices);
      if (!makeTrial(vertices))
      {
        return *std::move(ended_);
      }
      if (isFound())
      {
        break;
      }
      vertices = nextSize();
    }
    return conclude(resultOf(*std::move(enough_ ? enough_ : tooFew_)));
  }

  /// Whether the search is over: the smallest mesh that meets the tolerance is small enough, or the
  /// largest possible mesh misses it.
  bool isFound()
  {
    if (enough_ && !meets(enough_->error))
    {
      // A later trial has found less noise, so that the errors of earlier ones have grown.
      tooFew_.emplace(*std::move(enough_));
      enough_.reset();
    }
    if (!enough_)
    {
      return tooFew_->vertices() >= mostVertices();
    }
    const double least = std::max(enough(), tooFew_ ? double(tooFew_->vertices()) : 0.);
    return isLeast_ || enough_->isMadeAgain || double(enough_->vertices()) <= TimesTaken * least;
  }

  /// The size of the next trial: a little more than just enough by the trials so far, between the
  /// largest size that was too small and the smallest that was enough.
  std::uint64_t nextSize()
  {
    double size = (1. + (TimesEnough - 1.) * double(1 + missed_)) * enough();
    if (!enough_ && canMakeAgain() && noise_ == 0. && measured_.size() == 1)
    {
      size *= std::pow(size / double(tooFew_->vertices()), ExcessIfClean);
    }
    if (!enough_ && canMakeAgain() && !tooFew_->isMadeAgain &&
      size <= MostTimesForGain * double(tooFew_->vertices()))
    {
      size *= PartWithGain;
    }
    double least = double(FewestToAsk), most = double(mostVertices());
    if (enough_)
    {
      least = std::max(least, double(enough_->vertices()) / MostTimesFewer);
      most = std::min(most, double(enough_->vertices()) - 1.);
    }
    else
    {
      most = std::min(most, MostTimesMore * double(tooFew_->vertices()));
    }
    if (tooFew_)
    {
      least = std::max(least, LeastTimesMore * double(tooFew_->vertices()) + 1.);
    }
    isAimed_ = least <= std::ceil(size);
    return std::uint64_t(std::max(least, std::min(most, std::ceil(size))));
  }

  /// Makes and measures a mesh of so many vertices: from a finished mesh that is a little smaller,
  /// or larger, or from the mesh that was learnt last. Returns false if the run was ended: then
  /// `ended_` is its result.
  bool makeTrial(std::uint64_t vertices)
  {
    const ProgressPart part = next(PartOfTrial);
    const double middle = part.begin + PartOfGrowthOfTrial * (part.end - part.begin);
    const bool isRefined =
      tooFew_ && double(vertices) <= MostTimesRefined * double(tooFew_->vertices());
    const Made* const source = !canMakeAgain() ? nullptr
      : enough_                                ? &*enough_
      : isRefined                              ? &*tooFew_
                                               : nullptr;
    const std::uint64_t largest = measured_.empty() ? TimesFirst * vertices : vertices;
    LearntRun made = source ? source->run : learn(vertices, largest, { part.begin, middle });
    PhaseTimes times;
    times.enter(Phase::Finish);
    const bool isComplete = source ? run_.makeAgain(made, vertices, { middle, part.end })
      : made.result.isComplete()   ? run_.make(made, vertices, { middle, part.end })
                                   : false;
    times.leave();
    times_.add(times);
    if (!isComplete)
    {
      ended_ = run_.describe(std::move(made), vertices, { part.end, part.end });
      ended_->times.add(times_);
      return false;
    }
    times_.add(std::exchange(made.result.times, {}));
    const HeldOutError error = note(made.learnt.mesh);
    if (!source)
    {
      limitNoise(made.result);
    }
    const bool isMet = meets(error);
    isLeast_ = isMet && source && made.learnt.mesh.vertexCount() >= source->vertices();
    missed_ += source && !isMet ? 1 : 0;
    (isMet ? enough_ : tooFew_).emplace(Made{ std::move(made), error, source && isAimed_ });
    return true;
  }

  /// Whether finished meshes may be made again. Without a fit there is nothing to do, and feature
  /// strength belongs to the places where vertices have learnt.
  bool canMakeAgain() const
  {
    return request_.parameters.fitRounds > 0 && !request_.parameters.computeFeatureStrength;
  }

  /// The result of a run of this size, with the checks for thin parts and narrow holes that every run has.
  Reconstruction resultOf(Made made)
  {
    const ProgressPart part = next(PartOfResult);
    const std::uint64_t vertices = made.vertices();
    // Whoever ends the run here gets the mesh without a report.
    if (!request_.parameters.computeUncertainty && !progress_(part.begin))
    {
      made.run.result.stopReason = StopReason::Cancelled;
    }
    const Parameters parameters = parametersWith(vertices);
    const RunRequest request = requestWith(request_, parameters);
    const Progress ofOthers = partOf(progress_, part.end, 1.);
    return withFurtherRuns(run_.describe(std::move(made.run), vertices, part), request, ofOthers);
  }

  /// A power law of the error by the number of vertices, through one trial.
  struct Slope
  {
    double vertices; ///< of that trial
    double error;
    double exponent;
  };

  /// The slope between the largest trial that misses the tolerance and the next one. If all miss it
  /// or all meet it, the slope beyond the last or before the first.
  Slope slope() const
  {
    const auto isEnough = [&](const Measured& one) { return meets(one.error); };
    const auto first =
      std::find_if(measured_.rbegin(), measured_.rend(), std::not_fn(isEnough)).base();
    // The last of [0, below) misses the tolerance.
    const auto below = std::size_t(first - measured_.begin());
    if (below > 0 && below < measured_.size())
    {
      return slopeBetween(below - 1, below);
    }
    const std::size_t from = below > 0 ? below - 1 : 0;
    // Errors vary. So trials of nearly the same size do not count, and the exponent of others
    // counts half.
    constexpr double TimesApart = 1.5;
    Slope result{ double(measured_[from].vertices), errorOf(measured_[from].error), UsualExponent };
    for (std::size_t other = 0; other < measured_.size(); ++other)
    {
      const auto [fewer, more] = std::minmax(from, other);
      if (double(measured_[more].vertices) >= TimesApart * double(measured_[fewer].vertices))
      {
        result.exponent = 0.5 * (UsualExponent + slopeBetween(fewer, more).exponent);
      }
    }
    return result;
  }

  Slope slopeBetween(std::size_t fewer, std::size_t more) const
  {
    const Measured& a = measured_[fewer];
    const Measured& b = measured_[more];
    const double exponent = std::log(errorOf(a.error) / errorOf(b.error)) /
      std::log(double(b.vertices) / double(a.vertices));
    return { double(a.vertices), errorOf(a.error),
      std::isfinite(exponent) ? std::clamp(exponent, LeastExponent, MostExponent) : UsualExponent };
  }

  /// The number of vertices that just meets the tolerance, by the trials.
  double enough() const
  {
    const Slope by = slope();
    const double error = std::max(by.error, 1e-6 * choice_.length);
    const double times = std::pow(error / choice_.length, 1. / by.exponent);
    return std::clamp(times * by.vertices, double(FewestToAsk), double(mostVertices()));
  }

  double expected(std::uint64_t vertices) const
  {
    const Slope by = slope();
    return by.error * std::pow(by.vertices / double(vertices), by.exponent);
  }

  /// The largest size of a mesh. Under noise, more vertices would not come closer.
  std::uint64_t mostVertices() const
  {
    constexpr double PointsPerVertexLearnt = 2.;
    const double part = noise_ > 0. ? PointsPerVertexUnderNoise : PointsPerVertexLearnt;
    return std::max(FewestTried, std::uint64_t(double(points_) / part));
  }

  /// An error in units of the input, without noise.
  double errorOf(const HeldOutError& error) const
  {
    return request_.cloud.unit() * error.withoutNoise(choice_.goal.measure, noise_);
  }

  /// The mean square error that a mesh of one vertex would have from coarseness alone. It follows
  /// from the difference of two trials: the noise is in both.
  double coarseness() const
  {
    const Measured& fewer = measured_.front();
    const Measured& more = measured_.back();
    const auto power = [](const Measured& one)
    { return std::pow(double(one.vertices), -PowerOfCoarseness); };
    const auto square = [](const Measured& one)
    { return one.error.rootMeanSquare * one.error.rootMeanSquare; };
    return std::max(0., square(fewer) - square(more)) / (power(fewer) - power(more));
  }

  /// Lowers the noise to that of the fit if that is clearly less: then small trials took the shape
  /// of thin parts for noise.
  void limitNoise(const Reconstruction& result)
  {
    constexpr double ClearlyLess = 0.9;
    if (result.finish && result.finish->noise < ClearlyLess * noise_)
    {
      noise_ = result.finish->noise;
      choice_.noise = noise_ * request_.cloud.unit();
    }
  }

  std::uint64_t sizeByCloud()
  {
    double most = double(points_) / PointsPerVertexIfClean;
    double size = most;
    if (noise_ > 0.)
    {
      // At `balance`, coarseness and noise have equal parts. The chosen size is larger, so that
      // little coarseness is left.
      const double factor = coarseness();
      const double balance =
        std::pow(factor * double(points_) / (noise_ * noise_), 1. / (PowerOfCoarseness + 1.));
      most = double(points_) / PointsPerVertexUnderNoise;
      size = balance * std::pow(CoarsenessLeft, -1. / PowerOfCoarseness);
      const double unit = request_.cloud.unit();
      choice_.byNoise = ErrorUnderNoise{ unit * std::sqrt(factor), PowerOfCoarseness / 2.,
        unit * noise_ * std::sqrt(balance / double(points_)) };
    }
    if (const double atCreases = double(points_) / PointsPerVertexAtCreases;
        hasCreases() && atCreases < std::min(size, most))
    {
      most = atCreases;
      choice_.byCreases = true;
    }
    return std::uint64_t(std::clamp(size, double(points_) / PointsPerVertexAtLeast, most));
  }

  bool hasCreases() const
  {
    const double before = measured_.front().creases, after = measured_.back().creases;
    return after > WidthsOfCreases && after >= CreasesThatStay * before;
  }

  /// Measures and records the error of a mesh, and the noise if the mesh is one of the first. With
  /// more vertices, less of the shape is left in the difference between neighbours.
  HeldOutError note(const Mesh& mesh)
  {
    const std::uint64_t vertices = mesh.vertexCount();
    const HeldOutError error = heldOutError(request_.cloud, mesh, request_.executor);
    if (measured_.empty() ||
      (vertices > measured_.back().vertices && vertices <= points_ / FewestPointsThatTellNoise &&
        measured_.size() < MostThatTellNoise))
    {
      const double difference =
        differenceOfNeighbours(request_.cloud, mesh, error, request_.executor);
      const bool isNoise = isNoiseBy(difference, error.rootMeanSquare, vertices, points_);
      noise_ = isNoise ? difference : std::min(noise_, difference);
      choice_.noise = noise_ * request_.cloud.unit();
    }
    measured_.push_back({ vertices, error, creaseWidths(mesh, request_.executor) });
    std::ranges::sort(measured_, {}, &Measured::vertices);
    return error;
  }

  Parameters parametersWith(std::uint64_t vertices) const
  {
    Parameters parameters = request_.parameters;
    parameters.numberOfVertices = vertices;
    return parameters;
  }

  /// The next part of the whole progress, which takes this part of what is left.
  ProgressPart next(double part)
  {
    const double begin = done_;
    done_ += part * (1. - done_);
    return { begin, done_ };
  }

  /// The mesh from which one of so many vertices grows: the last one, if its first surface is fine
  /// enough for the largest size that is expected, else a new first surface.
  Beginning beginningFor(std::uint64_t vertices, std::uint64_t largest, ProgressPart part)
  {
    constexpr double TimesFiner = 1.5;
    // A first surface must have fewer vertices than the mesh that grows from it.
    constexpr double MostOfMesh = 0.8;
    const auto first = [this](std::uint64_t count)
    { return double(firstVertices(count, request_.parameters.fidelity)); };
    while (largest > vertices && first(largest) > MostOfMesh * double(vertices))
    {
      largest = std::max(vertices, largest / 2);
    }
    const bool isFine = grown_ && first(largest) <= TimesFiner * first(startedFor_);
    if (isFine && grown_->mesh && grown_->mesh->vertexCount() <= vertices)
    {
      return *grown_;
    }
    PhaseTimes times;
    times.enter(Phase::Start);
    startedFor_ = std::max(vertices, largest);
    start_ = run_.begin(startedFor_, part);
    times.leave();
    times_.add(times);
    return start_;
  }

  LearntRun learn(std::uint64_t vertices, std::uint64_t largest, ProgressPart part)
  {
    const double middle = part.begin + 0.2 * (part.end - part.begin);
    const Parameters parameters = parametersWith(vertices);
    const std::uint64_t learnt = verticesToLearn(requestWith(request_, parameters));
    Beginning beginning = beginningFor(learnt, largest, { part.begin, middle });
    LearntRun run = run_.learn(learnt, std::move(beginning), { middle, part.end }, none_);
    // A first surface that is larger than asked learns nothing. It is finished and simplified all
    // the same.
    run.isLearnt = true;
    grown_ = Beginning{ run.learnt.mesh, start_.gaps, start_.weights };
    return run;
  }

  /// Learns, finishes and measures a mesh. Returns false if the run was ended: then `ended_` is its
  /// result.
  bool tryWith(std::uint64_t vertices, std::uint64_t largest)
  {
    const ProgressPart part = next(PartOfTrial);
    const double middle = part.begin + PartOfGrowthOfTrial * (part.end - part.begin);
    LearntRun learnt = learn(vertices, largest, { part.begin, middle });
    times_.add(std::exchange(learnt.result.times, {}));
    PhaseTimes times;
    times.enter(Phase::Choice);
    if (!learnt.result.isComplete() || !run_.make(learnt, vertices, { middle, part.end }))
    {
      ended_ = run_.describe(std::move(learnt), vertices, { part.end, part.end });
      ended_->times.add(times_);
      return false;
    }
    note(learnt.learnt.mesh);
    times.leave();
    times_.add(times);
    return true;
  }

  Reconstruction ownRun(std::uint64_t vertices)
  {
    return reconstruct(request_.cloud, parametersWith(vertices), partOf(progress_, done_, 1.),
      request_.first, {}, {}, request_.executor, request_.hints, request_.explainsAll);
  }

  /// Measures the result and adds the choice of its size.
  Reconstruction conclude(Reconstruction result)
  {
    result.times.add(times_);
    if (!result.isComplete())
    {
      return result;
    }
    limitNoise(result);
    choice_.vertices = result.surface.vertexCount();
    for (const Measured& one : measured_)
    {
      if (one.vertices != choice_.vertices)
      {
        choice_.trials.push_back({ one.vertices, errorOf(one.error) });
      }
    }
    const HeldOutError error = heldOutError(request_.cloud, result.surface, request_.executor);
    choice_.reached = errorOf(error);
    choice_.least = leastTold(error, noise_) * request_.cloud.unit();
    if (const std::string warning = choice_.warning(); !warning.empty())
    {
      result.warnings.push_back(warning);
    }
    result.size = std::move(choice_);
    progress_(1.);
    return result;
  }

  RunRequest request_;
  const Progress& progress_;
  Run run_;
  std::uint64_t points_;
  Checkpoint none_;
  SizeChoice choice_;
  std::vector<Measured> measured_;
  double noise_ = 0.; ///< in units of the cloud
  Beginning start_;
  std::uint64_t startedFor_ = 0;
  std::optional<Beginning> grown_; ///< what was learnt last, before its fit
  double done_ = 0.;
  PhaseTimes times_;
  std::optional<Reconstruction> ended_;
  // With a tolerance: the smallest mesh that meets it, and the largest that misses it.
  std::optional<Made> enough_, tooFew_;
  bool isAimed_ = false;   ///< whether the next trial has the size that is expected to be enough
  bool isLeast_ = false;   ///< whether the shape needs all vertices of `enough_`
  std::size_t missed_ = 0; ///< number of refined trials that missed the tolerance
};
}

Reconstruction reconstructSized(
  const RunRequest& request, const SizeGoal& goal, const Progress& progress)
{
  const Progress told = rising(progress);
  return SizedRun(request, goal, told).run();
}
}
