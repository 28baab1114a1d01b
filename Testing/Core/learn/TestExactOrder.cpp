// SPDX-License-Identifier: BSD-3-Clause
#include "base/Random.h"
#include "learn/ExactOrder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>

namespace neuralmesh::testing
{
namespace
{
/// A number that is not negative, with an exponent without end.
struct Number
{
  long double fraction = 0.; ///< in [0.5, 1), or zero
  long exponent = 0;

  static Number of(long double value)
  {
    int exponent = 0;
    const long double fraction = std::frexp(value, &exponent);
    return { fraction, exponent };
  }
  friend Number operator*(Number a, Number b)
  {
    Number product = of(a.fraction * b.fraction);
    product.exponent += product.fraction > 0. ? a.exponent + b.exponent : 0;
    return product;
  }
  friend Number operator+(Number a, Number b)
  {
    if (a.fraction == 0. || b.fraction == 0.)
    {
      return a.fraction == 0. ? b : a;
    }
    if (a.exponent < b.exponent)
    {
      std::swap(a, b);
    }
    const long distance = std::min(a.exponent - b.exponent, 200l);
    Number sum = of(a.fraction + std::ldexp(b.fraction, -int(distance)));
    sum.exponent += a.exponent;
    return sum;
  }
  friend bool operator<(Number a, Number b)
  {
    if (a.fraction == 0. || b.fraction == 0.)
    {
      return a.fraction < b.fraction;
    }
    return a.exponent != b.exponent ? a.exponent < b.exponent : a.fraction < b.fraction;
  }
  friend bool operator==(Number a, Number b) { return !(a < b) && !(b < a); }

  /// Whether the numbers differ by more than rounding errors.
  static bool clearlyLess(Number a, Number b) { return a * of(1.L + 1e-9L) < b; }
};

/// Counters as the thesis has them: every one decays in every iteration.
class PlainCounters
{
public:
  explicit PlainCounters(std::size_t count)
  {
    for (VertexIndex v = 0; v < count; ++v)
    {
      this->counters_[v] = {};
    }
  }

  void pass(double decay)
  {
    for (auto& [v, counter] : this->counters_)
    {
      counter = counter * Number::of(decay);
    }
  }
  void win(VertexIndex winner, double gain, double decay)
  {
    this->pass(decay);
    this->counters_[winner] = this->counters_[winner] + Number::of(gain);
  }
  void split(VertexIndex v, VertexIndex added, double share)
  {
    const Number whole = this->counters_[v];
    this->counters_[v] = whole * Number::of(share);
    this->counters_[added] = whole * Number::of(1. - share);
  }
  void multiply(VertexIndex v, double factor)
  {
    this->counters_[v] = this->counters_[v] * Number::of(factor);
  }
  void add(VertexIndex v, double gain)
  {
    this->counters_[v] = this->counters_[v] + Number::of(gain);
  }
  void erase(VertexIndex v) { this->counters_.erase(v); }

  VertexIndex top() const
  {
    VertexIndex best = this->counters_.begin()->first;
    for (const auto& [v, counter] : this->counters_)
    {
      best = this->counters_.at(best) < counter ? v : best;
    }
    return best;
  }
  VertexIndex bottom() const
  {
    VertexIndex best = this->counters_.begin()->first;
    for (const auto& [v, counter] : this->counters_)
    {
      best = counter < this->counters_.at(best) ? v : best;
    }
    return best;
  }
  Number at(VertexIndex v) const { return this->counters_.at(v); }
  const std::map<VertexIndex, Number>& all() const { return this->counters_; }
  void replaceAll(std::map<VertexIndex, Number> counters) { this->counters_ = std::move(counters); }

private:
  std::map<VertexIndex, Number> counters_;
};

/// Whether the answer of an order is that of the counters, up to vertices whose counters differ by
/// rounding errors only.
bool agrees(const PlainCounters& counters, VertexIndex answer, VertexIndex expected)
{
  if (answer == expected)
  {
    return true;
  }
  const Number a = counters.at(answer), b = counters.at(expected);
  return !(a == b) && !Number::clearlyLess(a, b) && !Number::clearlyLess(b, a);
}

void passMany(ActivityOrder& order, int iterations, double decay)
{
  for (int i = 0; i < iterations; ++i)
  {
    order.pass(decay);
  }
}
}

// At the start all counters are zero, and the lowest index is top and bottom.
TEST(ExactOrder, StartsWithZeros)
{
  ExactOrder order(5);
  EXPECT_EQ(order.top(), 0u);
  EXPECT_EQ(order.bottom(), 0u);
  EXPECT_TRUE(order.isBottomBelow(1e-300, 0.));
  for (VertexIndex v = 0; v < 5; ++v)
  {
    EXPECT_EQ(order.activity(v), 0.);
  }
}

// Wins add and all counters decay, as (6.5) and (6.6) have it.
TEST(ExactOrder, CountersOfTheThesis)
{
  ExactOrder order(3);
  order.win(1, 1., 0.5);
  order.win(1, 1., 0.5);
  order.win(2, 1., 0.5);
  order.pass(0.5);
  EXPECT_DOUBLE_EQ(order.activity(1), 0.375);
  EXPECT_DOUBLE_EQ(order.activity(2), 0.5);
  EXPECT_EQ(order.top(), 2u);
  EXPECT_EQ(order.bottom(), 0u);
  order.split(2, 3, 0.25);
  EXPECT_DOUBLE_EQ(order.activity(2), 0.125);
  EXPECT_DOUBLE_EQ(order.activity(3), 0.375);
  // 1 and 3 are equal: the lower index goes first.
  EXPECT_EQ(order.top(), 1u);
  order.erase(0);
  EXPECT_EQ(order.bottom(), 2u);
  EXPECT_TRUE(order.isBottomBelow(0.126, 0.));
  EXPECT_FALSE(order.isBottomBelow(0.124, 0.));
}

// Vertices idle for so long that a double would have become zero are told apart all the same.
TEST(ExactOrder, OrderOutlivesUnderflow)
{
  constexpr double decay = 0.95;
  ExactOrder order(6);
  order.win(4, 1., decay);
  passMany(order, 100, decay);
  order.win(2, 1., decay);
  passMany(order, 30000, decay);
  order.win(5, 1., decay);
  passMany(order, 30000, decay);
  order.win(0, 1., decay);
  passMany(order, 30000, decay);
  order.win(1, 1., decay);
  order.win(3, 1., decay);
  ASSERT_EQ(order.activity(4), 0.);
  ASSERT_EQ(order.activity(2), 0.);
  ASSERT_EQ(order.activity(0), 0.);
  for (const VertexIndex laziest : { 4, 2, 5, 0, 1 })
  {
    EXPECT_EQ(order.bottom(), laziest);
    EXPECT_TRUE(order.isBottomBelow(1., 0.));
    order.erase(laziest);
  }
  EXPECT_EQ(order.top(), 3u);
}

// Vertices with the same past are equal, however small; the lowest index goes first.
TEST(ExactOrder, TiesGoToTheLowestIndex)
{
  ExactOrder order(1);
  order.win(0, 1., 0.95);
  order.split(0, 7, 0.5);
  order.split(7, 3, 0.5);
  order.split(0, 5, 0.5);
  passMany(order, 50000, 0.95);
  for (const VertexIndex v : { 0, 3, 5, 7 })
  {
    EXPECT_EQ(order.top(), v);
    EXPECT_EQ(order.bottom(), v);
    order.erase(v);
    if (v != 7)
    {
      EXPECT_NE(order.top(), v);
    }
  }
}

// A vertex that was idle for long and wins again is worth a win, not less.
TEST(ExactOrder, LateWinCountsInFull)
{
  ExactOrder order(2);
  order.win(0, 1., 0.95);
  passMany(order, 40000, 0.95);
  order.win(1, 1., 0.95);
  order.pass(0.95);
  order.win(0, 1., 0.95);
  EXPECT_EQ(order.top(), 0u);
  EXPECT_NEAR(order.activity(0), 1., 1e-12);
  EXPECT_NEAR(order.activity(1), 0.95 * 0.95, 1e-12);
}

// A win that is worth nothing leaves the order as it was, even after a long time.
TEST(ExactOrder, WinWithoutGainKeepsTheOrder)
{
  ExactOrder order(3);
  order.win(2, 1., 0.95);
  order.win(1, 1., 0.95);
  order.win(0, 1., 0.95);
  passMany(order, 60000, 0.95);
  order.win(0, 0., 0.95);
  EXPECT_EQ(order.top(), 0u);
  EXPECT_EQ(order.bottom(), 2u);
}

// After a demotion another vertex gets its turn; the demoted one stays in the order.
TEST(ExactOrder, DemotedTopGivesWay)
{
  ExactOrder order(3);
  for (int i = 0; i < 5; ++i)
  {
    order.win(1, 1., 1.);
  }
  for (int i = 0; i < 4; ++i)
  {
    order.win(2, 1., 1.);
  }
  order.demoteTop();
  EXPECT_EQ(order.top(), 2u);
  order.demoteTop();
  EXPECT_EQ(order.top(), 1u);
  EXPECT_EQ(order.bottom(), 0u);
  EXPECT_GT(order.activity(1), 0.);
}

// After promotions another vertex gets its turn; the promoted one is no longer below one win.
TEST(ExactOrder, PromotedBottomGivesWay)
{
  ExactOrder order(2);
  order.win(0, 1., 1.);
  order.win(0, 1., 1.);
  order.pass(0.9);
  ASSERT_EQ(order.bottom(), 1u);
  order.promoteBottom();
  EXPECT_FALSE(order.isBottomBelow(0.999, 0.));
  order.promoteBottom();
  EXPECT_EQ(order.bottom(), 0u);
  EXPECT_NEAR(order.activity(1), 2., 1e-12);
}

// The order is that of plain counters that all decay in every iteration, after any operations.
TEST(ExactOrder, AgreesWithPlainCounters)
{
  constexpr std::size_t Start = 6;
  constexpr std::size_t Most = 24;
  const std::unique_ptr<ActivityOrder> order = std::make_unique<ExactOrder>(Start);
  PlainCounters counters(Start);
  std::set<VertexIndex> unused;
  VertexIndex end = Start;
  Random random(42);
  const auto anyVertex = [&]
  {
    auto place = counters.all().begin();
    std::advance(place, random.below(std::uint32_t(counters.all().size())));
    return place->first;
  };
  constexpr std::array<double, 4> decays{ 0.95, 0.5, 0.999, 1. };
  int zeros = 0;

  for (int i = 0; i < 100000; ++i)
  {
    const double decay = decays[random.below(decays.size())];
    const std::uint32_t kind = random.below(1000);
    if (kind < 500)
    {
      // Winners are drawn unevenly, so that some are idle for long.
      const VertexIndex v = random.below(4) > 0 ? counters.all().begin()->first : anyVertex();
      const double gain = random.below(3) == 0 ? 1. : 0.001 + 2. * random.uniform();
      order->win(v, gain, decay);
      counters.win(v, gain, decay);
    }
    else if (kind < 700)
    {
      order->pass(decay);
      counters.pass(decay);
    }
    else if (kind < 800 && counters.all().size() < Most)
    {
      const VertexIndex v = anyVertex();
      const VertexIndex added = unused.empty() ? end++ : unused.extract(unused.begin()).value();
      const double share = random.below(2) == 0 ? 0.5 : 0.05 + 0.9 * random.uniform();
      order->split(v, added, share);
      counters.split(v, added, share);
    }
    else if (kind < 880 && counters.all().size() > 2)
    {
      const VertexIndex v = random.below(2) == 0 ? order->bottom() : anyVertex();
      order->erase(v);
      counters.erase(v);
      unused.insert(v);
    }
    else if (kind < 920)
    {
      counters.multiply(order->top(), 0.5);
      order->demoteTop();
    }
    else if (kind < 960)
    {
      counters.add(order->bottom(), 1.);
      order->promoteBottom();
    }
    else if (kind < 980)
    {
      std::vector<VertexIndex> sequence;
      for (const auto& [v, counter] : counters.all())
      {
        sequence.push_back(v);
      }
      std::map<VertexIndex, Number> renumbered;
      for (std::size_t left = sequence.size(); left > 1; --left)
      {
        std::swap(sequence[left - 1], sequence[random.below(std::uint32_t(left))]);
      }
      for (std::size_t k = 0; k < sequence.size(); ++k)
      {
        renumbered[VertexIndex(k)] = counters.at(sequence[k]);
      }
      order->renumber(sequence);
      counters.replaceAll(std::move(renumbered));
      unused.clear();
      end = VertexIndex(sequence.size());
    }
    else if (kind == 980 && i % 3 == 0)
    {
      for (int idle = 0; idle < 20000; ++idle)
      {
        order->pass(0.95);
        counters.pass(0.95);
      }
    }

    ASSERT_TRUE(agrees(counters, order->top(), counters.top())) << "operation " << i;
    ASSERT_TRUE(agrees(counters, order->bottom(), counters.bottom())) << "operation " << i;
    const double threshold = std::exp2(-20. * random.uniform());
    const Number bottom = counters.at(counters.bottom());
    const Number limit = Number::of(threshold);
    if (Number::clearlyLess(bottom, limit) || Number::clearlyLess(limit, bottom))
    {
      ASSERT_EQ(order->isBottomBelow(threshold, 0.), bottom < limit) << "operation " << i;
    }
    const VertexIndex v = anyVertex();
    const Number counter = counters.at(v);
    if (counter.exponent > -1000)
    {
      const auto expected = double(std::ldexp(counter.fraction, int(counter.exponent)));
      ASSERT_NEAR(order->activity(v), expected, 1e-9 * expected) << "operation " << i;
    }
    else
    {
      ++zeros;
      ASSERT_LT(order->activity(v), 0x1p-990) << "operation " << i;
    }
  }
  // Counters out of a double's range did occur.
  EXPECT_GT(zeros, 100);
}
}
