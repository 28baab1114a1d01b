// SPDX-License-Identifier: BSD-3-Clause
#include "base/OrderStatistics.h"
#include "base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

namespace neuralmesh::testing
{
// It is what sorting gives, whatever the numbers: of both signs, of all sizes, equal ones, infinite.
TEST(OrderStatistics, AgreesWithSorting)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  Random random(4);
  for (const std::size_t count : { 1, 2, 3, 100, 5000, 50000 })
  {
    for (const double scale : { 1., 1e-300, 1e300 })
    {
      std::vector<double> numbers{ 0. };
      while (numbers.size() < count)
      {
        const double number = scale * (random.uniform() - 0.5);
        const unsigned kind = random.below(10);
        numbers.push_back(kind == 0 ? numbers[random.below(std::uint32_t(numbers.size()))]
            : kind == 1             ? double(float(number))
            : kind == 2             ? (number < 0. ? -Infinity : Infinity)
                                    : number);
      }
      std::vector<double> sorted = numbers;
      std::sort(sorted.begin(), sorted.end());
      // One that holds all, one that holds nothing, and one that holds too many.
      const std::array<std::pair<OrderStatisticSearch::Bracket, int>, 3> brackets{
        { { { -Infinity, Infinity, count + 1 }, 1 }, { { 3., 4., 10 }, 5 },
          { { -Infinity, Infinity, 1 }, 5 } }
      };
      for (const std::size_t rank : { std::size_t(0), count / 100, count / 2, count - 1 })
      {
        for (const auto& [bracket, mostSweeps] : brackets)
        {
          OrderStatisticSearch search(rank, bracket);
          int sweeps = 0;
          // Once it is found, more sweeps for the sake of another search do no harm.
          for (bool isLast = false; !isLast; sweeps += isLast ? 0 : 1)
          {
            isLast = search.isFound();
            for (const double number : numbers)
            {
              search.add(number);
            }
            search.endSweep();
          }
          EXPECT_EQ(search.value(), sorted[rank]) << rank << " of " << count;
          EXPECT_LE(sweeps, mostSweeps);
        }
      }
    }
  }
}
}
