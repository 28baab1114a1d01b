// SPDX-License-Identifier: BSD-3-Clause
// Prints, as a table in Markdown, what checkpoints cost: the size of the file, and the time that it
// takes to write it and to go on from it.
#include "cloud/CloudGenerator.h"
#include "learn/SequentialLearner.h"
#include "mesh/Refinement.h"
#include "run/Checkpoint.h"
#include "Shapes.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

namespace
{
using namespace neuralmesh;

constexpr std::size_t PointCount = 1'000'000;

template <typename Use>
double secondsOf(const Use& use)
{
  const auto begin = std::chrono::steady_clock::now();
  use();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void printRow(const PointCloud& cloud, std::size_t vertices, Order order)
{
  Mesh mesh = Mesh::tetrahedron(Vector4(), 0.5f);
  refine(mesh, vertices, [](double) { return true; });
  Parameters parameters;
  parameters.order = order;
  parameters.numberOfVertices = 2 * vertices;
  const std::string path =
    (std::filesystem::temp_directory_path() / "neuralmesh-table.checkpoint").string();
  std::filesystem::remove(path);

  SequentialLearner learner(cloud, parameters, mesh), resumed(cloud, parameters, mesh);
  StoppingRules rules(cloud, parameters);
  LearningCurve curve;
  LearningState state{ learner, rules, curve }, resumedState{ resumed, rules, curve };
  CheckpointPlan plan;
  plan.path = path;
  plan.interval = 0.;
  Checkpoint first(plan, cloud, parameters);
  first.resume(state, true);
  learner.learn(1000);
  const double writing = secondsOf([&] { first.saveIfDue(state); });
  const double reading = secondsOf(
    [&]
    {
      Checkpoint second(plan, cloud, parameters);
      second.resume(resumedState, true);
    });
  const auto size = double(std::filesystem::file_size(path));
  std::printf("| %s | %zu | %.1f | %.0f | %.2f | %.2f |\n",
    order == Order::Exact ? "exact" : "list", vertices, 1e-6 * size, size / double(vertices),
    writing, reading);
  std::filesystem::remove(path);
}
}

int main()
{
  CloudOptions options;
  options.count = PointCount;
  const PointCloud cloud(generateCloud(makeSphere(), options));
  std::printf("| order | vertices | MB | bytes a vertex | s to write | s to go on |\n");
  std::printf("|---|--:|--:|--:|--:|--:|\n");
  for (const Order order : { Order::Exact, Order::List })
  {
    for (const std::size_t vertices : { 20'000, 200'000, 1'000'000 })
    {
      printRow(cloud, vertices, order);
    }
  }
  return 0;
}
