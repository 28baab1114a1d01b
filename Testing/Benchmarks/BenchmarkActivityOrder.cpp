// SPDX-License-Identifier: BSD-3-Clause
#include "ExactOrder.h"
#include "Random.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace
{
using namespace neuralmesh;

/// Wins of random vertices, and a split and an erasure after every fiftieth, as in a run.
void exactOrder(benchmark::State& state)
{
  const auto count = std::uint32_t(state.range(0));
  ExactOrder order(count);
  Random random(1);
  const double decay = std::exp2(-1. / (6. * count));
  const auto win = [&] { order.win(random.below(count), 1., decay); };
  for (std::uint32_t i = 0; i < 10 * count; ++i)
  {
    win();
  }
  std::uint32_t sinceSplit = 0;
  for (auto _ : state)
  {
    win();
    if (++sinceSplit == 50)
    {
      sinceSplit = 0;
      const VertexIndex top = order.top();
      const VertexIndex bottom = order.bottom();
      if (top != bottom)
      {
        order.erase(bottom);
        order.split(top, bottom, 0.5);
      }
    }
  }
}
BENCHMARK(exactOrder)->Arg(10'000)->Arg(100'000)->Arg(1'000'000);
}
