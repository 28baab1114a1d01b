// SPDX-License-Identifier: BSD-3-Clause
// Prints, as a table in Markdown, what growth costs: for each size the time of a sample there and
// the time of the whole run up to there, with our order and with a naive one, which is given up
// once it has taken too long.
#include "cloud/CloudGenerator.h"
#include "learn/ExactOrder.h"
#include "learn/SequentialLearner.h"
#include "NaiveOrder.h"
#include "Shapes.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <vector>

namespace
{
using namespace neuralmesh;

constexpr std::size_t PointCount = 2'000'000;
constexpr double NaiveSeconds = 60.;
/// The cost of a sample at a size is measured while the mesh grows by this factor.
constexpr double MeasuredGrowth = 1.1;

double processorSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

struct Row
{
  std::size_t vertices;
  double total = 0.;     ///< seconds until there
  double perSample = 0.; ///< nanoseconds
};

std::vector<Row> grow(const PointCloud& cloud, const std::vector<std::size_t>& sizes,
  std::unique_ptr<ActivityOrder> order, double mostSeconds)
{
  Parameters parameters;
  parameters.numberOfVertices = std::uint64_t(2 * double(sizes.back()));
  const Vector4 center(0.f, 0.f, 0.f);
  SequentialLearner learner(cloud, parameters, Mesh::tetrahedron(center, 0.1f), std::move(order));
  std::vector<Row> rows;
  const double start = processorSeconds();
  for (const std::size_t size : sizes)
  {
    while (learner.mesh().vertexCount() < size)
    {
      learner.learn(learner.batchSize());
      if (processorSeconds() - start > mostSeconds)
      {
        return rows;
      }
    }
    const double here = processorSeconds();
    const std::uint64_t before = learner.counts().iterations;
    while (double(learner.mesh().vertexCount()) < MeasuredGrowth * double(size))
    {
      learner.learn(learner.batchSize());
    }
    const double samples = double(learner.counts().iterations - before);
    rows.push_back({ size, here - start, 1e9 * (processorSeconds() - here) / samples });
  }
  return rows;
}
}

int main()
{
  const std::vector<std::size_t> sizes{ 1'000, 5'000, 10'000, 20'000, 50'000, 100'000, 200'000,
    500'000 };
  CloudOptions options;
  options.count = PointCount;
  const PointCloud cloud(generateCloud(makeTorus(), options));

  const auto ours =
    grow(cloud, sizes, std::make_unique<ExactOrder>(4), std::numeric_limits<double>::infinity());
  const auto naive = grow(cloud, sizes, std::make_unique<NaiveOrder>(4), NaiveSeconds);

  std::printf("A torus of %zu points. CPU time on one core.\n\n", PointCount);
  std::printf("| vertices | ns a sample | seconds in all | seconds / (n log2 n), x 10^6 | "
              "seconds in all, naive order | naive / ours |\n");
  std::printf("|--:|--:|--:|--:|--:|--:|\n");
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    const double n = double(ours[i].vertices);
    std::printf("| %zu | %.0f | %.2f | %.2f | ", ours[i].vertices, ours[i].perSample, ours[i].total,
      1e6 * ours[i].total / (n * std::log2(n)));
    if (i < naive.size())
    {
      std::printf("%.2f | %.1f |\n", naive[i].total, naive[i].total / ours[i].total);
    }
    else
    {
      std::printf("over %.0f | |\n", NaiveSeconds);
    }
  }
  return 0;
}
