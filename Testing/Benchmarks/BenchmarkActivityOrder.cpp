// SPDX-License-Identifier: BSD-3-Clause
#include "AvlList.h"
#include "base/Random.h"
#include "learn/ActivityList.h"
#include "learn/ExactOrder.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
using namespace neuralmesh;

/// Exact counters, behind the operations of the lists: a win for a jump, a split for an insertion.
class Counters
{
public:
  explicit Counters(std::uint32_t count)
    : order_(count)
    , decay_(std::exp2(-1. / (6. * count)))
  {
  }
  void win(VertexIndex winner) { this->order_.win(winner, 1., this->decay_); }
  void splitTopAfterErasingBottom()
  {
    const VertexIndex bottom = this->order_.bottom();
    this->order_.erase(bottom);
    this->order_.split(this->order_.top(), bottom, 0.5);
  }

private:
  ExactOrder order_;
  double decay_;
};

/// The activity list by one of its structures.
template <typename List>
class Jumps
{
public:
  explicit Jumps(std::uint32_t count)
  {
    for (VertexIndex v = 0; v < count; ++v)
    {
      this->list_.insert(v, v);
    }
  }
  void win(VertexIndex winner) { this->list_.jump(winner, this->list_.size() / 3); }
  void splitTopAfterErasingBottom()
  {
    const VertexIndex bottom = this->list_.at(0);
    this->list_.erase(bottom);
    const VertexIndex top = this->list_.at(this->list_.size() - 1);
    this->list_.erase(top);
    this->list_.insert(top, this->list_.size() / 2);
    this->list_.insert(bottom, this->list_.size() / 2);
  }

private:
  List list_;
};

/// The plainest list: an array that is searched and moved.
class ArrayList
{
public:
  std::size_t size() const { return this->vertices_.size(); }
  VertexIndex at(std::size_t position) const { return this->vertices_[position]; }
  void insert(VertexIndex v, std::size_t position)
  {
    this->vertices_.insert(this->vertices_.begin() + std::ptrdiff_t(position), v);
  }
  void erase(VertexIndex v)
  {
    this->vertices_.erase(std::find(this->vertices_.begin(), this->vertices_.end(), v));
  }
  void jump(VertexIndex v, std::size_t distance)
  {
    const auto place = std::find(this->vertices_.begin(), this->vertices_.end(), v);
    const auto last = this->vertices_.end() - 1;
    const auto target = place + std::min(std::ptrdiff_t(distance), last - place);
    std::rotate(place, place + 1, target + 1);
  }

private:
  std::vector<VertexIndex> vertices_;
};

/// Wins of random vertices, and a removal and a split after every fiftieth, as in a run.
template <typename Order>
void activityOrder(benchmark::State& state)
{
  const auto count = std::uint32_t(state.range(0));
  Order order(count);
  Random random(1);
  // Until counters and places are those of a long run; the array would take too long.
  const std::uint32_t before = std::is_same_v<Order, Jumps<ArrayList>> ? 0 : 5 * count;
  for (std::uint32_t i = 0; i < before; ++i)
  {
    order.win(random.below(count));
  }
  std::uint32_t sinceSplit = 0;
  for (auto _ : state)
  {
    order.win(random.below(count));
    if (++sinceSplit == 50)
    {
      sinceSplit = 0;
      order.splitTopAfterErasingBottom();
    }
  }
}

void sizes(benchmark::internal::Benchmark* benchmark)
{
  benchmark->Arg(10'000)->Arg(100'000)->Arg(1'000'000);
}

BENCHMARK_TEMPLATE(activityOrder, Counters)->Name("order/exact counters")->Apply(sizes);
BENCHMARK_TEMPLATE(activityOrder, Jumps<ActivityList>)->Name("order/list: B-tree")->Apply(sizes);
BENCHMARK_TEMPLATE(activityOrder, Jumps<AvlList>)->Name("order/list: AVL and map")->Apply(sizes);
BENCHMARK_TEMPLATE(activityOrder, Jumps<ArrayList>)->Name("order/list: array")->Apply(sizes);
}
