// SPDX-License-Identifier: BSD-3-Clause
// What each step of learning costs while a mesh grows, by the order of its vertices: the thesis's
// preset, with the search through all counters that the thesis began with, with its activity list,
// or with exact counters in heaps. Prints a table of comma-separated values. Times are those of one
// core.
#include "learn/LearningCurve.h"
#include "learn/SequentialLearner.h"
#include "NaiveOrder.h"

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

namespace
{
using namespace neuralmesh;

enum class Way
{
  Search,
  List,
  Heaps
};

/// Rows come whenever the mesh has grown by this factor.
constexpr double RowGrowth = 1.2;
constexpr std::size_t FirstRow = 200;

struct Options
{
  std::string cloud;
  Way way = Way::Heaps;
  Parameters parameters;
};

/// CPU seconds of this thread: what others do on the machine is not among them.
double threadSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// What it takes to read the clock, which is as much as a short step takes.
double clockSeconds()
{
  constexpr int Readings = 10000;
  const double start = threadSeconds();
  double end = start;
  for (int i = 0; i < Readings; ++i)
  {
    end = threadSeconds();
  }
  return (end - start) / Readings;
}

/// Seconds and calls of each step.
class StopWatch
{
public:
  void begin(Step step)
  {
    const double now = threadSeconds();
    this->seconds_[std::size_t(this->step_)] += now - this->since_ - this->clock_;
    this->since_ = now;
    this->step_ = step;
    ++this->calls_[std::size_t(step)];
  }
  /// Leaves out what has passed since the last step began.
  void skip() { this->since_ = threadSeconds(); }

  double seconds(Step step) const { return this->seconds_[std::size_t(step)]; }
  std::uint64_t calls(Step step) const { return this->calls_[std::size_t(step)]; }

private:
  std::array<double, 4> seconds_{};
  std::array<std::uint64_t, 4> calls_{};
  Step step_ = Step::Basic;
  double clock_ = clockSeconds();
  double since_ = threadSeconds();
};

Options parse(int argc, char* argv[])
{
  const std::map<std::string, Way> ways{ { "search", Way::Search }, { "list", Way::List },
    { "heaps", Way::Heaps } };
  const std::map<std::string, Variant> variants{ { "basic", Variant::Basic },
    { "noise", Variant::NoiseFiltering } };
  Options options;
  Variant variant = Variant::NoiseFiltering;
  std::uint64_t vertices = 0;
  std::uint64_t seed = 1;
  double smoothingRate = -1.;
  bool topologyLearning = false;
  CLI::App app("What each step of learning costs while a mesh grows");
  app.add_option("cloud", options.cloud, "x, y, z of all points, 4-byte floats")->required();
  app.add_option("--order", options.way)->transform(CLI::CheckedTransformer(ways));
  app.add_option("--variant", variant)->transform(CLI::CheckedTransformer(variants));
  app.add_option("--vertices", vertices)->required()->check(CLI::Range(4, 1000000000));
  app.add_option("--seed", seed);
  app.add_option("--smoothing-rate", smoothingRate)->check(CLI::Range(0., 1.));
  app.add_flag("--topology", topologyLearning);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    std::exit(app.exit(error));
  }
  const Order order = options.way == Way::List ? Order::List : Order::Exact;
  options.parameters = Parameters::of(Preset::Thesis, variant, order);
  options.parameters.numberOfVertices = vertices;
  options.parameters.seed = seed;
  options.parameters.topologyLearning = topologyLearning;
  if (smoothingRate >= 0.)
  {
    options.parameters.smoothingRate = smoothingRate;
  }
  return options;
}

PointCloud readCloud(const std::string& path)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<float> numbers(file ? std::size_t(file.tellg()) / sizeof(float) : 0);
  file.seekg(0);
  file.read(
    reinterpret_cast<char*>(numbers.data()), std::streamsize(numbers.size() * sizeof(float)));
  if (!file || numbers.size() < 3)
  {
    throw std::runtime_error(path + ": cannot be read");
  }
  std::vector<Eigen::Vector3d> points(numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2] };
  }
  return PointCloud(points);
}

SequentialLearner makeLearner(const PointCloud& cloud, const Options& options)
{
  SequentialLearner learner(cloud, options.parameters);
  if (options.way != Way::Search)
  {
    return learner;
  }
  return SequentialLearner(
    cloud, options.parameters, learner.mesh(), std::make_unique<NaiveOrder>(4));
}

void printRow(const LearningCurve::Row& row, const StopWatch& watch)
{
  std::printf("%zu,%llu,%.6f", row.vertices, static_cast<unsigned long long>(row.counts.iterations),
    row.regularRatio);
  for (const Step step :
    { Step::Basic, Step::NodeAddition, Step::NodeRemoval, Step::TopologyLearning })
  {
    std::printf(",%.6f", watch.seconds(step));
  }
  for (const Step step : { Step::NodeAddition, Step::NodeRemoval, Step::TopologyLearning })
  {
    std::printf(",%llu", static_cast<unsigned long long>(watch.calls(step)));
  }
  std::printf(",%llu\n", static_cast<unsigned long long>(row.counts.removals));
}

void grow(const PointCloud& cloud, const Options& options)
{
  SequentialLearner learner = makeLearner(cloud, options);
  std::printf("vertices,iterations,regular_ratio,basic_seconds,addition_seconds,removal_seconds,"
              "topology_seconds,additions,removals,topology_calls,removed\n");
  LearningCurve curve;
  StopWatch watch;
  learner.watchSteps([&watch](Step step) { watch.begin(step); });
  std::size_t nextRow = FirstRow;
  learner.learn(std::numeric_limits<std::uint64_t>::max() / 2,
    [&]
    {
      if (learner.mesh().vertexCount() >= nextRow || learner.isComplete())
      {
        watch.begin(Step::Basic);
        curve.add(learner, 1., 0.);
        printRow(curve.rows().back(), watch);
        nextRow = std::size_t(RowGrowth * double(learner.mesh().vertexCount()));
        watch.skip();
      }
    });
}
}

int main(int argc, char* argv[])
{
  try
  {
    const Options options = parse(argc, argv);
    const PointCloud cloud = readCloud(options.cloud);
    grow(cloud, options);
    return 0;
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
