// SPDX-License-Identifier: BSD-3-Clause
#include "base/Morton.h"
#include "cloud/CloudGenerator.h"
#include "cloud/PointCloud.h"
#include "cloud/SampleStream.h"
#include "cloud/VertexGrid.h"
#include "Shapes.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
using namespace neuralmesh;

/// Closest of the points of a sphere to random others of it; samples one by one in random order
/// (batches of one) or in batches of an eighth of the points, in Morton order.
void closestVertex(benchmark::State& state)
{
  CloudOptions options;
  options.count = std::size_t(state.range(0));
  const PointCloud vertices(generateCloud(makeSphere(), options));
  options.seed = 2;
  options.count = 1'000'000;
  const PointCloud cloud(generateCloud(makeSphere(), options));

  const double edge = std::sqrt(1.15 * (4. * M_PI / 12.) / double(state.range(0)));
  VertexGrid grid;
  grid.reset(vertices.bulkMin(), vertices.bulkMax(), float(2. * edge), vertices.points().size());
  for (VertexIndex v = 0; v < vertices.points().size(); ++v)
  {
    grid.insert(v, vertices.points()[v]);
  }
  SampleStream samples(cloud.points(), 1);
  const auto batch = state.range(1) ? std::size_t(state.range(0)) / 8 : 1;
  std::size_t searched = 0;
  for (auto _ : state)
  {
    for (const Vector4 sample : samples.draw(batch))
    {
      benchmark::DoNotOptimize(grid.closest(sample, vertices.points()));
    }
    searched += batch;
  }
  state.SetItemsProcessed(std::int64_t(searched));
}
BENCHMARK(closestVertex)
  ->ArgNames({ "vertices", "sorted" })
  ->ArgsProduct({ { 10'000, 100'000, 1'000'000 }, { 0, 1 } });
}
