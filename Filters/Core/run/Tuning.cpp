// SPDX-License-Identifier: BSD-3-Clause
#include "run/Tuning.h"

#include "base/Choices.h"
#include "base/Median.h"
#include "fit/FidelityRounds.h"
#include "fit/SurfaceFit.h"
#include "run/TuningPatch.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <sstream>
#include <thread>

namespace neuralmesh
{
namespace
{
constexpr std::size_t LeastProbes = 1000;
constexpr std::array FidelitiesToTry = { Fidelity::Default, Fidelity::High };
constexpr double LeastGain = 0.01;
constexpr double LeastGainInDoubts = 3.;
/// Larger lambdas are tried only if the noise, in mean edges, is larger. With less there is nothing
/// to smooth.
constexpr double NoiseToSmooth = 0.05;
/// No lambda is tried if the automatic lambdas of patches differ by a larger factor.
constexpr double MostSmoothnessOverLeast = 3.;

std::string text(double value, int digits = 2)
{
  std::ostringstream stream;
  stream.precision(digits);
  stream << value;
  return stream.str();
}

/// The word for a value, or the value with so many digits.
std::string text(std::string_view parameter, double value, int digits = 2)
{
  const std::string_view word = tunedWord(parameter, value);
  return word.empty() ? text(value, digits) : std::string(word);
}

std::string inWords(const TuningTrial& trial)
{
  return std::string(trial.parameter) + " " + text(trial.parameter, trial.value) + " instead of " +
    text(trial.parameter, trial.before);
}

/// Rounds to two digits, so that the value in the report is the one in use.
double rounded(double value)
{
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
  return unit * std::round(value / unit);
}

double meanOf(std::span<const double> values)
{
  double sum = 0.;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / double(values.size());
}

/// The reduction of squared distances.
struct Comparison
{
  double before = 0.;
  double gain = 0.;
  double doubt = 0.; ///< standard error of the gain
};

/// Compares means of blocks of points, as points side by side have similar distances. The fifth of
/// the blocks that gain most and the fifth that lose most do not count (a trimmed mean): a gap or a
/// fold in one mesh makes the other one no better.
Comparison compare(std::span<const double> before, std::span<const double> after)
{
  constexpr std::size_t Blocks = 100;
  constexpr double FarthestMedians = 6.;
  const double limit =
    FarthestMedians * FarthestMedians * medianOf(std::vector<double>(before.begin(), before.end()));
  if (!std::isfinite(limit))
  {
    return {};
  }
  std::vector<double> befores, gains;
  for (std::size_t block = 0; block < Blocks; ++block)
  {
    double sum = 0., gain = 0., count = 0.;
    for (std::size_t i = block * before.size() / Blocks; i < (block + 1) * before.size() / Blocks;
         ++i)
    {
      if (before[i] <= limit && after[i] <= limit)
      {
        sum += before[i];
        gain += before[i] - after[i];
        ++count;
      }
    }
    if (count > 0.)
    {
      befores.push_back(sum / count);
      gains.push_back(gain / count);
    }
  }
  if (gains.empty())
  {
    return {};
  }
  std::sort(gains.begin(), gains.end());
  const std::size_t trimmed = gains.size() / 5;
  const std::span<const double> middle(gains.data() + trimmed, gains.size() - 2 * trimmed);
  const double mean = meanOf(middle);
  double variance = 0.;
  for (const double gain : gains)
  {
    const double apart = std::clamp(gain, middle.front(), middle.back()) - mean;
    variance += apart * apart / double(gains.size());
  }
  const double kept = double(middle.size()) / double(gains.size());
  return { meanOf(befores), mean, std::sqrt(variance / double(gains.size())) / kept };
}

/// Tries values one after another.
class Tuner
{
public:
  Tuner(const PointCloud& cloud, const Parameters& wanted, const Progress& progress,
    const Executor& executor)
    : cloud_(cloud)
    , progress_(progress)
    , executor_(executor)
    , patches_(TuningPatch::patchesOf(cloud, learnable(wanted, cloud)))
    , smoothness_(patches_.size())
    , isClean_(patches_.size())
  {
    result_.parameters = wanted;
  }

  std::optional<Tuning> run()
  {
    if (learn())
    {
      chooseFidelity();
      chooseSmoothness();
    }
    return isCancelled_ ? std::nullopt : std::optional(std::move(result_));
  }

private:
  /// Learns with the present parameters. Returns whether there are enough points to measure by.
  bool learn()
  {
    onAll([&](std::size_t i, const Progress& progress)
      { patches_[i].learn(forTrial(result_.parameters), progress); });
    const PatchMeshes meshes = finishAll(result_.parameters, 1.);
    std::size_t probes = 0;
    double noise = 0.;
    for (std::size_t i = 0; i < meshes.size() && !isCancelled_; ++i)
    {
      if (meshes[i])
      {
        const auto& [mesh, report] = *meshes[i];
        noise += report.noise / mesh.meanEdge() / double(meshes.size());
        patches_[i].aim(mesh);
        probes += patches_[i].probeCount();
      }
    }
    if (isCancelled_)
    {
      return false;
    }
    const bool areFinished =
      std::all_of(meshes.begin(), meshes.end(), [](const auto& mesh) { return mesh.has_value(); });
    if (!areFinished || probes < LeastProbes)
    {
      result_.remarks.emplace_back("there are too few points for a comparison");
      return false;
    }
    noise_ = noise;
    best_ = measure(meshes);
    readSmoothness(meshes);
    return true;
  }

  void chooseFidelity()
  {
    const Fidelity wanted = result_.parameters.fidelity;
    for (const Fidelity fidelity : FidelitiesToTry)
    {
      const Fidelity before = result_.parameters.fidelity;
      if (fidelity <= before)
      {
        continue;
      }
      const TuningTrial trial{ "Fidelity", double(before), double(fidelity) };
      if (!hasOtherRounds(before, fidelity))
      {
        result_.remarks.push_back(inWords(trial) + " was not tried: under noise it is the same");
        break;
      }
      Parameters tried = result_.parameters;
      tried.fidelity = fidelity;
      if (!isBetter(tried, 1., trial))
      {
        break;
      }
      result_.parameters = tried;
    }
    if (result_.parameters.fidelity != wanted)
    {
      result_.choices.push_back(
        { "Fidelity", double(wanted), double(result_.parameters.fidelity) });
    }
  }

  /// Whether two fidelities make different rounds on any patch.
  bool hasOtherRounds(Fidelity one, Fidelity other) const
  {
    return std::any_of(isClean_.begin(), isClean_.end(),
      [&](bool isClean)
      { return FidelityRounds::count(one, isClean) != FidelityRounds::count(other, isClean); });
  }

  /// Tries smaller and larger factors of the automatic lambda.
  void chooseSmoothness()
  {
    if (result_.parameters.fitSmoothness > 0.)
    {
      return;
    }
    const auto [least, most] = std::minmax_element(smoothness_.begin(), smoothness_.end());
    if (*most > MostSmoothnessOverLeast * *least)
    {
      result_.remarks.emplace_back("no FitSmoothness was tried: the data give " + text(*least) +
        " at one place and " + text(*most) + " at another, and none of them suits the whole");
      return;
    }
    const double byData = medianOf(smoothness_);
    double best = 1.;
    const auto tryFactors = [&](double first, double second)
    {
      for (const double factor : { first, second })
      {
        if (factor * byData < SurfaceFit::LeastSmoothness ||
          !isBetter(
            result_.parameters, factor, { "FitSmoothness", best * byData, factor * byData }))
        {
          return;
        }
        best = factor;
      }
    };
    tryFactors(0.5, 0.25);
    if (best == 1. && noise_ > NoiseToSmooth)
    {
      tryFactors(2., 4.);
    }
    if (best != 1.)
    {
      const double chosen = rounded(best * byData);
      result_.parameters.fitSmoothness = chosen;
      result_.choices.push_back({ "FitSmoothness", 0., chosen });
    }
  }

  /// The parameters of a trial, which only the number of vertices ends.
  static Parameters forTrial(Parameters parameters)
  {
    parameters.maximumIterations = 0;
    parameters.targetSampleDistance = 0.;
    parameters.targetCloudDistance = 0.;
    parameters.targetNormalChange = 0.;
    parameters.timeLimit = 0.;
    parameters.computeUncertainty = false;
    return parameters;
  }

  /// The mesh of each patch; nothing if it was not finished.
  using PatchMeshes = std::vector<std::optional<PatchMesh>>;

  /// Finishes the learnt meshes of all patches. Each has its automatic lambda times a factor.
  PatchMeshes finishAll(const Parameters& parameters, double factor)
  {
    PatchMeshes meshes(patches_.size());
    onAll(
      [&](std::size_t i, const Progress& progress)
      {
        Parameters own = forTrial(parameters);
        if (factor != 1.)
        {
          own.fitSmoothness = factor * smoothness_[i];
        }
        meshes[i] = patches_[i].finish(own, progress);
      });
    ++runCount_;
    return meshes;
  }

  void readSmoothness(const PatchMeshes& meshes)
  {
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      smoothness_[i] = meshes[i]->report.smoothness;
      isClean_[i] = meshes[i]->report.isClean;
    }
  }

  /// Calls work(patch, progress) for all patches, with as many at once as the executor runs.
  template <typename Work>
  void onAll(const Work& work)
  {
    const std::thread::id asking = std::this_thread::get_id();
    std::atomic<bool> isCancelled = isCancelled_;
    executor_.forEachPart(patches_.size(),
      [&](std::size_t i)
      {
        // Only the calling thread may call the progress of the caller.
        const Progress progress = [&](double)
        {
          if (std::this_thread::get_id() == asking && !progress_(done()))
          {
            isCancelled = true;
          }
          return !isCancelled;
        };
        work(i, progress);
      });
    isCancelled_ = isCancelled;
  }

  double done() const
  {
    constexpr double MostRuns = 6.;
    return std::min(1., runCount_ / MostRuns);
  }

  std::vector<double> measure(const PatchMeshes& meshes) const
  {
    std::vector<double> squared;
    for (std::size_t i = 0; i < meshes.size(); ++i)
    {
      const std::vector<double> own = patches_[i].squaredDistances(meshes[i]->mesh);
      squared.insert(squared.end(), own.begin(), own.end());
    }
    return squared;
  }

  bool isBetter(const Parameters& parameters, double factor, TuningTrial trial)
  {
    if (isCancelled_)
    {
      return false;
    }
    const PatchMeshes meshes = finishAll(parameters, factor);
    if (isCancelled_)
    {
      return false;
    }
    const std::vector<double> squared = measure(meshes);
    const auto [before, gain, doubt] = compare(best_, squared);
    trial.error = cloud_.unit() * std::sqrt(std::max(0., before - gain));
    trial.gain = before > 0. ? gain / before : 0.;
    trial.doubt = before > 0. ? doubt / before : 0.;
    trial.isTaken = trial.gain > std::max(LeastGain, LeastGainInDoubts * trial.doubt);
    result_.trials.push_back(trial);
    if (trial.isTaken)
    {
      best_ = squared;
      if (factor == 1.)
      {
        readSmoothness(meshes);
      }
    }
    return trial.isTaken;
  }

  const PointCloud& cloud_;
  const Progress& progress_;
  const Executor& executor_;
  std::vector<TuningPatch> patches_;
  std::vector<double> smoothness_; ///< lambda by the data, of each patch
  std::vector<bool> isClean_;      ///< whether it has no noise to speak of
  std::vector<double> best_;       ///< squared distances with the best parameters so far
  double noise_ = 0.;              ///< of mean edges
  int runCount_ = 0;
  bool isCancelled_ = false;
  Tuning result_;
};
}

std::string TuningChoice::assignment() const
{
  constexpr int Digits = 3;
  return std::string(parameter) + "=" + text(parameter, value, Digits);
}

std::string_view tunedWord(std::string_view parameter, double value)
{
  return parameter == "Fidelity" ? fidelityWords[std::size_t(value)] : std::string_view();
}

std::vector<std::string> Tuning::reasons() const
{
  std::vector<std::string> lines;
  for (const TuningTrial& trial : trials)
  {
    lines.push_back(inWords(trial) + (trial.isTaken ? ": taken" : ": not taken") +
      ", squares of held-out distances are " + text(100. * std::abs(trial.gain)) + " % " +
      (trial.gain < 0. ? "more" : "less") + " (standard error " + text(100. * trial.doubt) + " %)");
  }
  lines.insert(lines.end(), remarks.begin(), remarks.end());
  return lines;
}

std::optional<Tuning> tune(const PointCloud& cloud, const Parameters& wanted,
  const Progress& progress, const Executor& executor)
{
  if (wanted.fitRounds == 0)
  {
    return Tuning{ wanted, {}, {}, { "there is no fit, so there is nothing to choose" } };
  }
  return Tuner(cloud, wanted, progress, executor).run();
}
}
