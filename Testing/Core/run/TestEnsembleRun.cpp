// SPDX-License-Identifier: BSD-3-Clause
// Promise: an ensemble gives a mesh with the handles of the cloud to start from, the same however processes share
// the members; and wherever it is ended, there is a mesh, too.
#include "run/EnsembleRun.h"

#include "MeshTools.h"
#include "SphereRuns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <functional>
#include <mutex>
#include <thread>

namespace neuralmesh::testing
{
namespace
{
const PointCloud& ringCloud()
{
  static const PointCloud cloud = []
  {
    CloudOptions options;
    options.count = 20000;
    return PointCloud(generateCloud(makeTorus(), options));
  }();
  return cloud;
}

EnsembleParameters fiveMembers()
{
  EnsembleParameters parameters;
  parameters.numberOfMembers = 5;
  parameters.verticesPerMember = 400;
  parameters.gridResolution = 24;
  return parameters;
}

void ignore(EnsembleStep) {}

EnsembleStart started(const PointCloud& cloud, const Progress& progress = goOn,
  const Parameters& refinement = small(), const EnsembleProcesses& processes = EnsembleProcesses())
{
  return startByEnsemble(
    cloud, fiveMembers(), refinement, progress, ignore, Executor::sequential(), processes);
}

/// What threads that play processes share.
class Meeting
{
public:
  explicit Meeting(std::size_t count)
    : count_(count)
    , barrier_(std::ptrdiff_t(count))
  {
  }

  std::size_t count() const { return count_; }

  /// The numbers of all, put together.
  template <typename Number, typename Combine>
  void combine(std::span<Number> own, const Combine& combined)
  {
    barrier_.arrive_and_wait();
    {
      const std::lock_guard lock(mutex_);
      sums_.resize(own.size());
      std::transform(own.begin(), own.end(), sums_.begin(), sums_.begin(),
        [&](Number a, double b) { return combined(double(a), b); });
    }
    barrier_.arrive_and_wait();
    std::transform(sums_.begin(), sums_.end(), own.begin(), [](double sum) { return Number(sum); });
    barrier_.arrive_and_wait();
    const std::lock_guard lock(mutex_);
    sums_.clear();
  }

private:
  std::size_t count_;
  std::barrier<> barrier_;
  std::mutex mutex_;
  std::vector<double> sums_;
};

class PlayedProcess : public EnsembleProcesses
{
public:
  PlayedProcess(Meeting& meeting, std::size_t index)
    : meeting_(meeting)
    , index_(index)
  {
  }

  EnsembleShare share() const override { return { index_, meeting_.count() }; }
  void findLargest(std::span<int> numbers) const override
  {
    meeting_.combine(numbers, [](double a, double b) { return std::max(a, b); });
  }
  void addUp(std::span<double> numbers) const override
  {
    meeting_.combine(numbers, std::plus<double>());
  }
  void addUp(std::span<std::uint8_t> numbers) const override
  {
    meeting_.combine(numbers, std::plus<double>());
  }

private:
  Meeting& meeting_;
  std::size_t index_;
};

/// Each process with a progress of its own.
std::vector<EnsembleStart> startedTogether(const std::vector<Progress>& progresses)
{
  Meeting meeting(progresses.size());
  std::vector<EnsembleStart> starts(progresses.size());
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < progresses.size(); ++i)
  {
    threads.emplace_back([&, i]
      { starts[i] = started(ringCloud(), progresses[i], small(), PlayedProcess(meeting, i)); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  return starts;
}
}

// The start is a closed mesh with a handle, less fine than what it is refined to; steps come one after the other,
// progress rises, and ends where the refinement begins.
TEST(EnsembleRun, StartsWithTheHandle)
{
  std::vector<EnsembleStep> steps;
  double last = 0.;
  const EnsembleStart start = startByEnsemble(
    ringCloud(), fiveMembers(), small(),
    [&](double fraction)
    {
      EXPECT_GE(fraction, last);
      last = fraction;
      return true;
    },
    [&](EnsembleStep step) { steps.push_back(step); });
  EXPECT_EQ(steps,
    (std::vector{ EnsembleStep::Population, EnsembleStep::Averaging, EnsembleStep::Refinement }));
  ASSERT_TRUE(start.isAverage());
  EXPECT_EQ(defectOf(*start.mesh), "");
  EXPECT_TRUE(reportOf(*start.mesh).isClosed());
  EXPECT_EQ(reportOf(*start.mesh).genus(), 1);
  EXPECT_LE(start.mesh->vertexCount(), 125u);
  EXPECT_EQ(start.warning, "");
  EXPECT_FALSE(start.isCancelled);
  EXPECT_EQ(start.timeLimit, 0.);
  EXPECT_LE(last, start.end);
  EXPECT_LT(start.end, 1.);
}

// Two processes make of their shares what one makes of all.
TEST(EnsembleRun, ProcessesShareMembers)
{
  const EnsembleStart alone = started(ringCloud());
  const std::vector<EnsembleStart> together = startedTogether({ goOn, goOn });
  ASSERT_TRUE(alone.isAverage() && together[0].isAverage());
  EXPECT_EQ(alone.votes->votes, together[0].votes->votes);
  EXPECT_EQ(alone.votes->votes, together[1].votes->votes);
  EXPECT_EQ(trianglesOf(*alone.mesh), trianglesOf(*together[0].mesh));
  EXPECT_FALSE(together[1].mesh);
}

// Whichever process is ended, all are.
TEST(EnsembleRun, OneProcessEndsAll)
{
  int reports = 0;
  const auto starts = startedTogether({ goOn, [&](double) { return ++reports < 3; } });
  for (const EnsembleStart& start : starts)
  {
    EXPECT_TRUE(start.isCancelled);
    EXPECT_FALSE(start.votes);
  }
  EXPECT_TRUE(starts[0].mesh);
  EXPECT_FALSE(starts[1].mesh);
}

// Ended while members are learnt, while phantoms are looked for, and while voxels are, there is the first member.
TEST(EnsembleRun, CanBeEndedAnywhere)
{
  for (const double end : { 0., 0.2, 0.5, 0.9 })
  {
    double whole = 0.;
    started(ringCloud(),
      [&](double fraction)
      {
        whole = fraction;
        return true;
      });
    const EnsembleStart start =
      started(ringCloud(), [&](double fraction) { return fraction < end * whole; });
    EXPECT_TRUE(start.isCancelled);
    EXPECT_FALSE(start.votes);
    ASSERT_TRUE(start.mesh);
    EXPECT_EQ(defectOf(*start.mesh), "");
  }
}

// Where there is no time for all members, learning goes on from the first one; what is left of the limit is no
// more than it was, and never none.
TEST(EnsembleRun, TimeLimit)
{
  Parameters refinement = small();
  refinement.timeLimit = 1e-6;
  const EnsembleStart late = started(ringCloud(), goOn, refinement);
  EXPECT_FALSE(late.votes);
  EXPECT_FALSE(late.isCancelled);
  EXPECT_TRUE(late.mesh);
  EXPECT_GT(late.timeLimit, 0.);
  EXPECT_LE(late.timeLimit, 1e-6);
}

// Members of a plane have no inside: nothing to start from, and a warning that says so.
TEST(EnsembleRun, PlanesAreWarnedOf)
{
  std::vector<Eigen::Vector3d> plane;
  Random random(1);
  for (int i = 0; i < 5000; ++i)
  {
    const double x = random.uniform();
    plane.emplace_back(x, random.uniform(), 0.);
  }
  const EnsembleStart start = started(PointCloud(plane));
  EXPECT_TRUE(start.votes);
  EXPECT_FALSE(start.mesh);
  EXPECT_NE(start.warning.find("Learning begins as without an ensemble"), std::string::npos);
}
}
