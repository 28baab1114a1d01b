// SPDX-License-Identifier: BSD-3-Clause
// Prints what it takes to make a cloud ready and, as a table in Markdown, whole runs of up to a million
// vertices: what a sample costs, how much memory a vertex takes beyond the cloud, and how good the mesh
// is. Sizes in thousands of vertices are arguments.
#include "AnonymousBytes.h"
#include "base/FreedArrays.h"
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "run/Reconstruction.h"
#include "Shapes.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace
{
using namespace neuralmesh;
using neuralmesh::testing::anonymousBytes;

constexpr std::size_t PointCount = 5'000'000;
/// The thesis's largest mesh took so long, on a Pentium 4 of 1.7 GHz.
constexpr double AtlasVertices = 270'000.;
constexpr double AtlasSeconds = (3. * 60. + 46.) * 60.;

/// The most memory that a part of a run has used.
class Peak
{
public:
  Peak(double begin, double end)
    : begin_(begin)
    , end_(end)
  {
  }
  void measure(double fraction)
  {
    if (fraction >= this->begin_ && fraction < this->end_)
    {
      this->bytes_ = std::max(this->bytes_, anonymousBytes());
    }
  }
  double bytes() const { return this->bytes_; }

private:
  double begin_, end_;
  double bytes_ = 0.;
};

/// Of the whole process.
double mostBytes = 0.;

/// Bytes of memory that were in use at most since the last call.
double peakBytes()
{
  double kilobytes = 0.;
  std::string word;
  for (std::ifstream file("/proc/self/status"); file >> word;)
  {
    if (word == "VmHWM:")
    {
      file >> kilobytes;
    }
  }
  std::ofstream("/proc/self/clear_refs") << 5;
  mostBytes = std::max(mostBytes, 1024. * kilobytes);
  return 1024. * kilobytes;
}

/// Tells what making it took, beside the points themselves.
PointCloud makeCloud(const std::vector<Eigen::Vector3d>& points, const Executor& executor)
{
  peakBytes();
  const double before = peakBytes();
  PhaseTimes times;
  times.enter(Phase::Cloud);
  PointCloud cloud(points, {}, false, executor);
  times.leave();
  std::printf("A torus of %zu points, on %u threads; the cloud of them took %.1f bytes a point at "
              "its peak, of which it keeps 16, and %.2f CPU s. Bytes in the table are those beyond "
              "it.\n\n",
    points.size(), executor.threadCount(), (peakBytes() - before) / double(points.size()),
    times.seconds(Phase::Cloud));
  return cloud;
}

void printRow(const PointCloud& cloud, std::uint64_t vertices, const Executor& executor)
{
  Parameters parameters;
  parameters.numberOfVertices = vertices;
  const double before = anonymousBytes();
  const double part = partOfFirstRun(parameters);
  Peak learning(part * StartOfLearning, part * EndOfLearning), finish(part * EndOfLearning, 1.);
  const auto begin = std::chrono::steady_clock::now();
  const Reconstruction result = reconstruct(
    cloud, parameters,
    [&](double fraction)
    {
      learning.measure(fraction);
      finish.measure(fraction);
      return true;
    },
    {}, {}, {}, executor);
  const double wall =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double learningSeconds = result.times.seconds(Phase::Learning);
  const double cpu =
    result.times.seconds(Phase::Start) + learningSeconds + result.times.seconds(Phase::Finish);
  const auto bytesPerVertex = [&](const Peak& peak)
  { return (peak.bytes() - before) / double(vertices); };
  // One can assume that the thesis's time grows as the number of vertices does.
  const double atlas = AtlasSeconds / AtlasVertices * double(vertices);
  std::printf("| %llu | %.0f | %.0f | %.0f | %.1f | %.1f | %.0f | %.2e | %ld | %zu | %.1f |\n",
    static_cast<unsigned long long>(vertices),
    1e9 * learningSeconds / double(result.counts.iterations), bytesPerVertex(learning),
    bytesPerVertex(finish), cpu, wall, atlas / cpu, result.quality->residual / cloud.diagonal(),
    result.quality->surface.genus.value_or(-1), result.quality->surface.foldedEdges,
    100. * result.quality->surface.regularRatio);
  std::fflush(stdout);
}
}

int main(int argc, char* argv[])
{
  returnFreedArrays();
  std::vector<std::uint64_t> sizes;
  for (int i = 1; i < argc; ++i)
  {
    sizes.push_back(1000 * std::strtoull(argv[i], nullptr, 10));
  }
  CloudOptions options;
  options.count = PointCount;
  const ThreadPool executor;
  const PointCloud cloud = makeCloud(generateCloud(makeTorus(), options), executor);
  std::printf(
    "| vertices | learning, ns a sample | learning, bytes a vertex | finish, bytes a vertex "
    "| CPU s | wall s | the thesis's time / CPU time | residual / diagonal | handles | folds "
    "| regular, %% |\n");
  std::printf("|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  for (const std::uint64_t vertices :
    sizes.empty() ? std::vector<std::uint64_t>{ 20'000, 270'000, 1'000'000 } : sizes)
  {
    printRow(cloud, vertices, executor);
  }
  peakBytes();
  std::printf("\nThe whole process: %.0f MB at its peak.\n", mostBytes / 1e6);
  return 0;
}
