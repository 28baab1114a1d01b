// SPDX-License-Identifier: BSD-3-Clause
// Prints, as a table in Markdown, how much faster two threads are than one, for the parts that run
// beside each other and for the whole run. The best of several rounds, one and two threads by turns.
#include "base/ThreadPool.h"
#include "cloud/CloudGenerator.h"
#include "cloud/CloudPlaces.h"
#include "fit/SurfaceFit.h"
#include "run/Reconstruction.h"
#include "Shapes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace neuralmesh;

constexpr std::size_t PointCount = 2'000'000;
constexpr std::uint64_t VertexCount = 200'000;
constexpr int Rounds = 4;

bool goOn(double) { return true; }

double secondsOf(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Seconds of a part on one thread and on two.
struct Row
{
  std::string name;
  std::array<double, 2> best{ std::numeric_limits<double>::infinity(),
    std::numeric_limits<double>::infinity() };

  void print() const
  {
    std::printf("| %s | %.4f | %.4f | %.2f |\n", this->name.c_str(), this->best[0], this->best[1],
      this->best[0] / this->best[1]);
  }
};

/// As steps of learning and fit do: each vertex takes from its neighbourhood and writes itself.
void passOver(std::vector<std::array<double, 8>>& values, const Executor& executor)
{
  executor.forEachRange(values.size(), values.size() / 256,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        values[i][1] += values[begin + (i * 37) % (end - begin)][0];
        values[i][0] = 0.5 * values[i][1];
      }
    });
}
}

int main()
{
  const ThreadPool one(1), two(2);
  const std::array<const Executor*, 2> executors{ &one, &two };
  CloudOptions options;
  options.count = PointCount;
  options.noise = 0.001;
  const std::vector<Eigen::Vector3d> points = generateCloud(makeTorus(), options);
  Parameters parameters;
  parameters.numberOfVertices = VertexCount;

  Row prepared{ "cloud made ready" }, learnt{ "start and learning" },
    winners{ "search for winners" }, projected{ "projection of samples" }, fitted{ "fit" },
    carried{ "places of all points" }, whole{ "whole run" }, passed{ "10 passes over 2 MB" };
  std::vector<std::array<double, 8>> values(32768);
  for (int round = 0; round < Rounds; ++round)
  {
    for (std::size_t i = 0; i < executors.size(); ++i)
    {
      const Executor& executor = *executors[i];
      const auto measure = [&](Row& row, const std::function<void()>& work)
      {
        const double seconds = secondsOf(work);
        row.best[i] = std::min(row.best[i], seconds);
        return seconds;
      };
      for (int repeat = 0; repeat < 100; ++repeat)
      {
        measure(passed,
          [&]
          {
            for (int pass = 0; pass < 10; ++pass)
            {
              passOver(values, executor);
            }
          });
      }
      std::optional<PointCloud> cloud;
      double all = measure(
        prepared, [&] { cloud.emplace(points, std::span<const double>(), false, executor); });
      Parameters unfinished = parameters;
      unfinished.fitRounds = 0;
      Mesh mesh;
      measure(learnt,
        [&] { mesh = reconstruct(*cloud, unfinished, goOn, {}, {}, {}, executor).surface; });
      const VertexGrid grid = gridOf(mesh, *cloud);
      std::vector<VertexIndex> closest(cloud->points().size());
      measure(winners, [&] { grid.closest(cloud->points(), mesh.positions(), closest, executor); });
      SurfaceFit fit(*cloud, mesh, 10 * VertexCount, executor);
      measure(projected, [&] { fit.findPlaces(goOn); });
      measure(fitted, [&] { fit.moveVertices(0., goOn); });
      measure(carried, [&] { const CloudPlaces places(*cloud, mesh, goOn, executor); });
      all += secondsOf([&] { reconstruct(*cloud, parameters, goOn, {}, {}, {}, executor); });
      whole.best[i] = std::min(whole.best[i], all);
    }
  }
  std::printf("A torus of %zu points, %llu vertices. Seconds, the best of %d rounds.\n\n",
    PointCount, static_cast<unsigned long long>(VertexCount), Rounds);
  std::printf("| part | 1 thread | 2 threads | ratio |\n|---|--:|--:|--:|\n");
  for (const Row* row :
    { &passed, &winners, &projected, &fitted, &carried, &prepared, &learnt, &whole })
  {
    row->print();
  }
  return 0;
}
