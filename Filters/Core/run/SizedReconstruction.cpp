// SPDX-License-Identifier: BSD-3-Clause
#include "run/SizedReconstruction.h"

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
/// Of the progress that is left, what a trial and the result take.
constexpr double PartOfTrial = 0.2, PartOfResult = 0.9;
/// ... and of a trial its growth.
constexpr double PartOfGrowthOfTrial = 0.4;
constexpr std::uint64_t FewestTried = 25;

// All that the cloud tells: trials of few vertices, of which the second tells the noise.
constexpr std::uint64_t PointsPerVertexAtFirst = 128;
constexpr std::uint64_t PointsPerVertexAtSecond = 32;
/// With fewer points a vertex neighbours are too far apart to tell noise.
constexpr std::uint64_t FewestPointsThatTellNoise = 8;
/// It takes time: the first trials tell it.
constexpr std::size_t MostThatTellNoise = 2;
/// More vertices than that bring hardly anything: without noise, and with some.
constexpr double PointsPerVertexIfClean = 2.2, PointsPerVertexUnderNoise = 3.3;
constexpr double PointsPerVertexAtLeast = 10.;
/// Without noise errors fall by a power of the number of vertices that becomes less: so many times that of the trials.
constexpr double ExponentAfterTrials = 0.62;
/// What the mesh is too coarse for falls by this power of the number of vertices, as a mean square.
constexpr double PowerOfCoarseness = 1.7;
/// What may be left of it, of what noise makes of a mesh that has a vertex for so many points.
constexpr double CoarsenessLeft = 0.04;

// A tolerance.
constexpr std::uint64_t PointsPerVertexOfGuess = 100;
constexpr std::uint64_t FewestToAsk = 4;
/// The first surface of the first trial is fine enough for so many times its vertices.
constexpr std::uint64_t TimesFirst = 4;
constexpr std::size_t MostTrials = 8;
/// A trial has at most so many times the vertices of the largest before it, and at least such a part of those of the
/// smallest: errors farther off are not told by it.
constexpr double MostTimesMore = 6., MostTimesFewer = 8.;
/// ... and so many times those of one that missed the tolerance, where none has met it.
constexpr double LeastTimesMore = 1.03;
/// A mesh that is made already is made again with up to so many times its vertices; of more a mesh learns.
constexpr double MostTimesRefined = 1.3;
/// With hardly more vertices it comes closer than any run makes as many: so much fewer are enough.
constexpr double MostTimesForGain = 1.2, PartWithGain = 0.93;
/// Errors vary from run to run: so many times the vertices that are expected to be just enough are made, and every trial
/// that misses the tolerance adds as much.
constexpr double TimesEnough = 1.04;
/// A mesh is taken that has up to so many times the vertices that are just enough; and one that was made again with so
/// many as were expected to be, for it is fitted more closely than what any run makes of as many.
constexpr double TimesTaken = 1.06;
constexpr double LeastExponent = 0.15, UsualExponent = 0.78, MostExponent = 2.5;

/// Whether what neighbours do not have in common is noise: more than the shape would make of it. The sparser the points
/// are at the vertices, the more that is.
bool isNoiseBy(double difference, double error, std::uint64_t vertices, std::uint64_t points)
{
  constexpr double Part = 0.6;
  const double part =
    Part * std::cbrt(double(PointsPerVertexAtSecond) * double(vertices) / double(points));
  return difference > std::min(part, 0.95) * error;
}

/// The least error that is told apart from none: by the standard error of a mean square under noise.
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

  /// A mesh that is made, and measured.
  struct Made
  {
    LearntRun run;
    HeldOutError error;
    bool isMadeAgain = false; ///< with so many as were expected to be enough

    std::uint64_t vertices() const { return run.learnt.mesh.vertexCount(); }
  };

  bool meets(const HeldOutError& error) const { return errorOf(error) <= choice_.length; }

  /// Trials, until one of them meets the tolerance with hardly more vertices than are enough: it is the result.
  Reconstruction runByTolerance()
  {
    // Smaller ones are simplified from as many as are learnt at least.
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

  /// Whether the smallest mesh that meets the tolerance is to be taken, or the largest that there may be does not.
  bool isFound()
  {
    if (enough_ && !meets(enough_->error))
    {
      // Later trials have told less noise.
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

  /// A little more than are just enough, by the trials; between those that are known to be too few and enough.
  std::uint64_t nextSize()
  {
    double size = (1. + (TimesEnough - 1.) * double(1 + missed_)) * enough();
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

  /// Makes and measures a mesh of so many vertices: of one that has a little fewer, or not far more, or from what was
  /// learnt last. False if that was ended: then there is what the run ends with.
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

  /// Not where nothing is fitted, nor where vertices are to stay where they have learnt what is told of them.
  bool canMakeAgain() const
  {
    return request_.parameters.fitRounds > 0 && !request_.parameters.computeFeatureStrength;
  }

  /// As any run would give it: thin parts are held.
  Reconstruction resultOf(Made made)
  {
    const ProgressPart part = next(PartOfResult);
    const std::uint64_t vertices = made.vertices();
    // Error bars take time, and tell of it.
    if (!request_.parameters.computeUncertainty && !progress_(part.end))
    {
      made.run.result.stopReason = StopReason::Cancelled;
    }
    const Parameters parameters = parametersWith(vertices);
    const RunRequest request = requestWith(request_, parameters);
    const Progress atTheEnd = partOf(progress_, part.end, part.end);
    return runWithThinParts(
      betterRun(run_.describe(std::move(made.run), vertices, part), request, atTheEnd), request,
      atTheEnd);
  }

  /// Two trials, between or beyond which errors follow a power of the number of vertices.
  struct Slope
  {
    double vertices; ///< of the one from which it is counted
    double error;
    double exponent;
  };

  /// Between the largest that does not meet the tolerance and the next one; else beyond the last, or before the first.
  Slope slope() const
  {
    const auto isEnough = [&](const Measured& one) { return meets(one.error); };
    const auto first =
      std::find_if(measured_.rbegin(), measured_.rend(), std::not_fn(isEnough)).base();
    // Of [0, below) the last does not meet it.
    const auto below = std::size_t(first - measured_.begin());
    if (below > 0 && below < measured_.size())
    {
      return slopeBetween(below - 1, below);
    }
    const std::size_t from = below > 0 ? below - 1 : 0;
    // Errors vary: what lies close together tells no power, and what lies apart not all of it.
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

  /// Vertices that just meet the tolerance, by the trials.
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

  /// What is learnt at most; under noise more would not come closer.
  std::uint64_t mostVertices() const
  {
    constexpr double PointsPerVertexLearnt = 2.;
    const double part = noise_ > 0. ? PointsPerVertexUnderNoise : PointsPerVertexLearnt;
    return std::max(FewestTried, std::uint64_t(double(points_) / part));
  }

  /// In units of the input, noise taken off.
  double errorOf(const HeldOutError& error) const
  {
    return request_.cloud.unit() * error.withoutNoise(choice_.goal.measure, noise_);
  }

  /// Of the mean square that the mesh is too coarse for, the factor of its power of the number of vertices: by how much
  /// less it is with more of them. Noise is in both.
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

  /// The fit of a finished mesh tells its noise: where that is clearly less, trials have taken the shape of thin parts
  /// for more.
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
      // Where coarseness and noise have equal parts, and farther on until little is left of the first.
      const double factor = coarseness();
      const double balance =
        std::pow(factor * double(points_) / (noise_ * noise_), 1. / (PowerOfCoarseness + 1.));
      most = double(points_) / PointsPerVertexUnderNoise;
      size = balance * std::pow(CoarsenessLeft, -1. / PowerOfCoarseness);
      const double unit = request_.cloud.unit();
      choice_.byNoise = ErrorUnderNoise{ unit * std::sqrt(factor), PowerOfCoarseness / 2.,
        unit * noise_ * std::sqrt(balance / double(points_)) };
    }
    return std::uint64_t(std::clamp(size, double(points_) / PointsPerVertexAtLeast, most));
  }

  /// Keeps what is known of a mesh. The more vertices it has, the less of the shape is left in what neighbours do not
  /// have in common.
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
    measured_.push_back({ vertices, error });
    std::ranges::sort(measured_, {}, &Measured::vertices);
    return error;
  }

  Parameters parametersWith(std::uint64_t vertices) const
  {
    Parameters parameters = request_.parameters;
    parameters.numberOfVertices = vertices;
    return parameters;
  }

  /// Where what comes next ends, of the whole progress.
  ProgressPart next(double part)
  {
    const double begin = done_;
    done_ += part * (1. - done_);
    return { begin, done_ };
  }

  /// What a mesh of so many vertices grows from: the last one, if its first surface is fine enough for the `largest`
  /// that is expected, or a new first surface.
  Beginning beginningFor(std::uint64_t vertices, std::uint64_t largest, ProgressPart part)
  {
    constexpr double TimesFiner = 1.5;
    // A mesh grows from a first surface of fewer vertices.
    constexpr double MostOfMesh = 0.8;
    while (largest > vertices && double(firstVertices(largest)) > MostOfMesh * double(vertices))
    {
      largest = std::max(vertices, largest / 2);
    }
    const bool isFine =
      grown_ && double(firstVertices(largest)) <= TimesFiner * double(firstVertices(startedFor_));
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
    // A first surface that has more vertices than are asked for is simplified, and learns nothing.
    run.isLearnt = true;
    grown_ = Beginning{ run.learnt.mesh, start_.gaps, start_.weights };
    return run;
  }

  /// Makes and measures a mesh. False if that was ended: then there is what the run ends with.
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

  /// Measures what the run ends with, and tells how it came to be.
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
  // For a tolerance: the smallest that meets it, and the largest that does not.
  std::optional<Made> enough_, tooFew_;
  bool isAimed_ = false;   ///< whether so many are made as are expected to be enough
  bool isLeast_ = false;   ///< the shape needs so many
  std::size_t missed_ = 0; ///< trials that were made again, and did not meet it
};
}

Reconstruction reconstructSized(
  const RunRequest& request, const SizeGoal& goal, const Progress& progress)
{
  return SizedRun(request, goal, progress).run();
}
}
