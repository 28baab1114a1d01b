// SPDX-License-Identifier: BSD-3-Clause
#include "run/EnsembleRun.h"

#include "base/WarningTopic.h"
#include "run/EnsembleAverage.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace neuralmesh
{
namespace
{
/// What phantoms and voxels take, as a fraction of the time in which members are learnt.
constexpr double TimeOfAveraging = 0.3;

/// Where the steps end, as fractions of the time of the run.
struct EnsembleSchedule
{
  EnsembleSchedule(const Ensemble& ensemble, const Parameters& refinement, const Executor& executor)
  {
    const std::size_t threads = std::min<std::size_t>(executor.threadCount(), ensemble.size());
    const double learning = ensemble.expectedSamples() / double(std::max<std::size_t>(1, threads));
    const double refining = double(refinement.numberOfVertices) * refinement.samplesPerAddition;
    const double whole = (1. + TimeOfAveraging) * learning + refining;
    population = learning / whole;
    averaging = (1. + TimeOfAveraging) * learning / whole;
  }

  double population;
  double averaging;
};

class EnsembleRun
{
public:
  EnsembleRun(Ensemble& ensemble, const EnsembleSchedule& schedule, const Progress& progress,
    const Executor& executor, const EnsembleProcesses& processes)
    : ensemble_(ensemble)
    , population_(partOf(progress, 0., schedule.population))
    , averaging_(partOf(progress, schedule.population, schedule.averaging))
    , executor_(executor)
    , processes_(processes)
  {
  }

  bool isCancelled() const { return isCancelled_; }
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// Learns all members. Returns false if there was no time for that, or it was ended, on whatever process.
  bool learnMembers(double timeLimit)
  {
    for (;;)
    {
      const bool goesOn = population_(ensemble_.progress());
      const bool isTimeOver = timeLimit > 0. && seconds() >= timeLimit;
      std::array<int, 3> any{ ensemble_.isLearnt() ? 0 : 1, goesOn ? 0 : 1, isTimeOver ? 1 : 0 };
      processes_.findLargest(any);
      const auto [isLearning, isEnded, isOver] = any;
      isCancelled_ = isCancelled_ || isEnded != 0;
      if (isLearning == 0 || isEnded != 0 || isOver != 0)
      {
        return isLearning == 0;
      }
      executor_.forEachPart(
        ensemble_.size(), [this](std::size_t member) { ensemble_.learn(member); });
    }
  }

  /// The votes of all members, of which each process has learnt its share; nothing if it was ended.
  std::optional<VoxelVotes> vote()
  {
    if (!forEachMember(0., [this](std::size_t member) { ensemble_.findPhantoms(member); }))
    {
      return std::nullopt;
    }
    std::vector<double> boxes = ensemble_.boxes();
    processes_.addUp(std::span(boxes));
    ensemble_.makeGrid(boxes);
    if (!forEachMember(0.5, [this](std::size_t member) { ensemble_.voxelize(member); }))
    {
      return std::nullopt;
    }
    VoxelVotes votes = ensemble_.votes();
    processes_.addUp(std::span(votes.votes));
    return votes;
  }

private:
  using Clock = std::chrono::steady_clock;

  /// Calls `body` with all members, in groups that run at the same time, and reports between them, in the
  /// half of the averaging that begins at `from`. Returns false if any process was ended.
  template <typename Body>
  bool forEachMember(double from, const Body& body)
  {
    const std::size_t group = executor_.threadCount();
    std::array<int, 1> isEnded{ 0 };
    for (std::size_t first = 0; first < ensemble_.size() && isEnded[0] == 0; first += group)
    {
      if (averaging_(from + 0.5 * double(first) / double(ensemble_.size())))
      {
        executor_.forEachPart(
          std::min(group, ensemble_.size() - first), [&](std::size_t i) { body(first + i); });
      }
      else
      {
        isEnded[0] = 1;
      }
    }
    processes_.findLargest(isEnded);
    isCancelled_ = isCancelled_ || isEnded[0] != 0;
    return isEnded[0] == 0;
  }

  Ensemble& ensemble_;
  Progress population_;
  Progress averaging_;
  const Executor& executor_;
  const EnsembleProcesses& processes_;
  Clock::time_point begin_ = Clock::now();
  bool isCancelled_ = false;
};

std::string warningOf(const EnsembleAverage& average)
{
  if (average.agreement >= EnsembleAverage::GoodAgreement)
  {
    return "";
  }
  return taggedWarning(WarningTopic::FirstMesh,
    "The members of the ensemble agree on only " +
      std::to_string(std::lround(100. * average.agreement)) + " % of their volume: the cloud is " +
      (average.mesh ? "open, thin or has too few points. The topology is unreliable."
                    : "open, flat or has too few points. Learning begins as without an ensemble.") +
      " Use no ensemble for open clouds.");
}
}

std::string_view name(EnsembleStep step)
{
  constexpr std::array<std::string_view, 3> Names{ "Learning the members", "Averaging",
    "Refining" };
  return Names[std::size_t(step)];
}

EnsembleStart startByEnsemble(const PointCloud& cloud, const EnsembleParameters& parameters,
  const Parameters& refinement, const Progress& progress,
  const std::function<void(EnsembleStep)>& enter, const Executor& executor,
  const EnsembleProcesses& processes)
{
  Ensemble ensemble(cloud, parameters, processes.share());
  const EnsembleSchedule schedule(ensemble, refinement, executor);
  EnsembleRun run(ensemble, schedule, progress, executor, processes);
  EnsembleStart start;
  start.end = schedule.averaging;
  enter(EnsembleStep::Population);
  const bool areLearnt = run.learnMembers(refinement.timeLimit);
  enter(EnsembleStep::Averaging);
  if (areLearnt)
  {
    start.votes = run.vote();
  }
  enter(EnsembleStep::Refinement);
  start.isCancelled = run.isCancelled();
  if (refinement.timeLimit > 0.)
  {
    // No time left is not the same as no limit.
    start.timeLimit =
      std::max(std::numeric_limits<double>::min(), refinement.timeLimit - run.seconds());
  }
  if (processes.share().index > 0)
  {
    return start;
  }
  if (!start.votes)
  {
    start.mesh = ensemble.renumberedMesh(0);
    return start;
  }
  EnsembleAverage average = averageOf(*start.votes, cloud, refinement.numberOfVertices);
  start.warning = warningOf(average);
  start.mesh = std::move(average.mesh);
  return start;
}
}
