// SPDX-License-Identifier: BSD-3-Clause
// Prints, as a table in Markdown, how long a run would take on many threads, one row for each of its phases,
// and how long it goes without asking whether to go on. All is measured on one thread, in CPU time: what runs
// beside each other is shared out among the threads as they would take it, so that the machine needs neither so
// many cores nor to be idle. What memory costs that many cores share is not in it.
// Arguments: thousands of vertices, thousands of points, threads.
#include "base/Executor.h"
#include "base/FreedArrays.h"
#include "cloud/CloudGenerator.h"
#include "run/Reconstruction.h"
#include "Shapes.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <queue>
#include <vector>

namespace
{
using namespace neuralmesh;

double cpuSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Runs all parts here, and tells how long so many threads would have taken.
class MeasuredExecutor final : public Executor
{
public:
  explicit MeasuredExecutor(unsigned threads)
    : threads_(threads)
  {
  }
  unsigned threadCount() const override { return threads_; }

  /// CPU seconds of what ran in parts.
  double partSeconds() const { return partSeconds_; }
  /// What of the seconds until now the threads have saved.
  double savedSeconds() const { return partSeconds_ - pathSeconds_; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    if (isAtWork_ || count < 2)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        part(context, i);
      }
      return;
    }
    isAtWork_ = true;
    // When each thread is free again: the first that is takes the next part.
    std::priority_queue<double, std::vector<double>, std::greater<>> free;
    for (unsigned thread = 0; thread < threads_; ++thread)
    {
      free.push(0.);
    }
    double last = 0., now = cpuSeconds();
    for (std::size_t i = 0; i < count; ++i)
    {
      part(context, i);
      const double after = cpuSeconds();
      const double end = free.top() + (after - now);
      partSeconds_ += after - now;
      now = after;
      free.pop();
      free.push(end);
      // At once, as a part may report progress.
      pathSeconds_ += std::max(0., end - last);
      last = std::max(last, end);
    }
    isAtWork_ = false;
  }

private:
  unsigned threads_;
  mutable bool isAtWork_ = false;
  mutable double partSeconds_ = 0.;
  mutable double pathSeconds_ = 0.;
};

/// Of a phase.
struct Row
{
  const char* name;
  double seconds = 0.;
  double serialSeconds = 0.;
  double pathSeconds = 0.;
  double longestSilence = 0.; ///< of the path
  double longestOnOne = 0.;   ///< on one thread

  void print() const
  {
    std::printf("| %s | %.2f | %.2f | %.2f | %.3f | %.3f |\n", this->name, this->seconds,
      this->serialSeconds, this->pathSeconds, this->longestOnOne, this->longestSilence);
  }
};

/// Adds up what each phase takes, from one report of progress to the next.
class Phases
{
public:
  explicit Phases(const MeasuredExecutor& executor)
    : executor_(executor)
    , now_(cpuSeconds())
  {
  }

  /// All since the last call counts for this phase.
  void take(Row& row, double fraction)
  {
    const double now = cpuSeconds();
    const double seconds = now - now_;
    const double parts = executor_.partSeconds() - parts_;
    const double path = seconds - (executor_.savedSeconds() - saved_);
    row.seconds += seconds;
    row.serialSeconds += seconds - parts;
    row.pathSeconds += path;
    row.longestSilence = std::max(row.longestSilence, path);
    row.longestOnOne = std::max(row.longestOnOne, seconds);
    if (std::getenv("NEURALMESH_SILENCES") && path > 0.1)
    {
      std::fprintf(stderr, "%s: %.3f s until %.4f of the run\n", row.name, path, fraction);
    }
    now_ = cpuSeconds();
    parts_ = executor_.partSeconds();
    saved_ = executor_.savedSeconds();
  }

private:
  const MeasuredExecutor& executor_;
  double now_;
  double parts_ = 0., saved_ = 0.;
};

std::size_t thousands(int argc, char* argv[], int which, std::size_t usual)
{
  return 1000 * (which < argc ? std::strtoull(argv[which], nullptr, 10) : usual);
}
}

int main(int argc, char* argv[])
{
  returnFreedArrays();
  Parameters parameters;
  parameters.numberOfVertices = thousands(argc, argv, 1, 200);
  CloudOptions options;
  options.count = thousands(argc, argv, 2, 1000);
  const auto threads = unsigned(thousands(argc, argv, 3, 16) / 1000);
  const std::vector<Eigen::Vector3d> points = generateCloud(makeTorus(), options);

  const MeasuredExecutor executor(threads);
  std::array<Row, 6> rows{ { { "cloud" }, { "start" }, { "learning" }, { "finish" }, { "report" },
    { "whole run" } } };
  Phases phases(executor);
  const PointCloud cloud(points, {}, false, executor);
  phases.take(rows[0], 0.);
  const double part = partOfFirstRun(parameters);
  const auto rowAt = [&](double fraction) -> Row&
  {
    return rows[fraction <= part * StartOfLearning ? 1
        : fraction <= part * EndOfLearning         ? 2
        : fraction < part * StartOfDescription     ? 3
                                                   : 4];
  };
  double before = 0.;
  reconstruct(
    cloud, parameters,
    [&](double fraction)
    {
      phases.take(rowAt(before == fraction ? fraction : (before + fraction) / 2.), fraction);
      before = fraction;
      return true;
    },
    {}, {}, {}, executor);
  phases.take(rows[4], 1.);
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
  {
    rows.back().seconds += rows[i].seconds;
    rows.back().serialSeconds += rows[i].serialSeconds;
    rows.back().pathSeconds += rows[i].pathSeconds;
    rows.back().longestSilence = std::max(rows.back().longestSilence, rows[i].longestSilence);
    rows.back().longestOnOne = std::max(rows.back().longestOnOne, rows[i].longestOnOne);
  }
  std::printf("A torus of %zu points, %zu vertices.\n\n", std::size_t(options.count),
    std::size_t(parameters.numberOfVertices));
  std::printf("| phase | 1 thread, s | of which no two parts ran beside each other, s "
              "| %u threads, s | longest time without asking, 1 thread, s | %u threads, s |\n",
    threads, threads);
  std::printf("|---|--:|--:|--:|--:|--:|\n");
  for (const Row& row : rows)
  {
    row.print();
  }
  return 0;
}
