// SPDX-License-Identifier: BSD-3-Clause
// Promise: an array that grows keeps its values, while what has moved gives its memory back, and then has room for as
// many as were asked for.
#include "base/TouchedVector.h"

#include "AnonymousBytes.h"
#include "base/ThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace neuralmesh::testing
{
namespace
{
#ifdef __linux__
/// Looks after each part how much memory is in use.
class MemoryWatch final : public Executor
{
public:
  unsigned threadCount() const override { return 1; }
  double mostBytes() const { return mostBytes_; }

protected:
  void run(std::size_t count, Part part, const void* context) const override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      part(context, i);
      mostBytes_ = std::max(mostBytes_, anonymousBytes());
    }
  }

private:
  mutable double mostBytes_ = 0.;
};

TEST(TouchedVector, TakesTheMemoryOfOneArrayAsItGrows)
{
  LargeVector<std::uint64_t> values(std::size_t(8) << 20, 1);
  const double array = double(values.size() * sizeof(std::uint64_t)), before = anonymousBytes();
  const MemoryWatch watch;
  reserveTouched(values, values.size() + 1000, watch);
  EXPECT_GT(watch.mostBytes(), 0.9 * before);
  EXPECT_LT(watch.mostBytes(), before + 0.2 * array);
}
#endif

TEST(TouchedVector, KeepsItsValuesAsItGrows)
{
  // Less than a page, and several parts, whole ones and not.
  for (const std::size_t count : { 0u, 1u, 65536u, 1048576u, 2500001u })
  {
    LargeVector<std::uint64_t> values(count);
    std::iota(values.begin(), values.end(), std::uint64_t(7));
    const ThreadPool executor(2);
    reserveTouched(values, count + 100'003, executor);
    ASSERT_EQ(values.size(), count);
    for (std::size_t i = 0; i < count; ++i)
    {
      ASSERT_EQ(values[i], i + 7) << count;
    }
    const std::uint64_t* const before = values.data();
    values.resize(count + 100'003, 0);
    EXPECT_EQ(values.data(), before) << count;
  }
}
}
}
